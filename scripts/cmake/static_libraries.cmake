# HDF5, matio, libcrypto and zlib as archives where the system has them all: as shared libraries they bring thirty more
# (HDF5's reader of web addresses: libcurl, Kerberos, GnuTLS), and the program takes 10 ms to start instead of 2. The
# targets keep their names; where an archive is missing or they do not link, everything stays shared.
option(TORQUESCOPE_STATIC_LIBRARIES "link HDF5, matio, libcrypto and zlib statically where there are archives of them"
  ON)

function(find_archives)
  set(found TRUE)
  foreach(name hdf5 matio crypto z sz aec)
    set(file lib${name}.a)
    if(name STREQUAL hdf5)
      set(file libhdf5_serial.a libhdf5.a)
    endif()
    find_library(TORQUESCOPE_ARCHIVE_${name} NAMES ${file})
    mark_as_advanced(TORQUESCOPE_ARCHIVE_${name})
    if(NOT TORQUESCOPE_ARCHIVE_${name})
      set(found FALSE)
    endif()
  endforeach()
  set(archives_found ${found} PARENT_SCOPE)
endfunction()

# two copies of HDF5 in one program would be worse than a slow start: all of them or none
function(link_statically)
  find_archives()
  if(NOT archives_found)
    return()
  endif()
  set(below_hdf5 ${TORQUESCOPE_ARCHIVE_sz} ${TORQUESCOPE_ARCHIVE_aec} ${TORQUESCOPE_ARCHIVE_z} m ${CMAKE_DL_LIBS})
  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_INCLUDES ${HDF5_C_INCLUDE_DIRS} ${MATIO_INCLUDE_DIRS} ${OPENSSL_INCLUDE_DIR})
  set(CMAKE_REQUIRED_LIBRARIES ${TORQUESCOPE_ARCHIVE_matio} ${TORQUESCOPE_ARCHIVE_hdf5} ${TORQUESCOPE_ARCHIVE_crypto}
                               ${below_hdf5} Threads::Threads)
  check_cxx_source_compiles("
    #include <hdf5.h>
    #include <matio.h>
    #include <openssl/sha.h>
    int main(int count, char** words) {
      unsigned char digest[32];
      SHA256(digest, 0, digest);
      return H5Fopen(words[0], 0u, H5P_DEFAULT) > 0 || Mat_Open(words[0], MAT_ACC_RDONLY) != nullptr || count > 9;
    }" TORQUESCOPE_ARCHIVES_LINK)
  if(NOT TORQUESCOPE_ARCHIVES_LINK)
    return()
  endif()
  # as targets of their own: only then the linker sees each archive before those it needs
  add_library(torquescope::sz STATIC IMPORTED)
  set_target_properties(torquescope::sz PROPERTIES
    IMPORTED_LOCATION ${TORQUESCOPE_ARCHIVE_sz} INTERFACE_LINK_LIBRARIES ${TORQUESCOPE_ARCHIVE_aec})
  add_library(torquescope::matio STATIC IMPORTED)
  set_target_properties(torquescope::matio PROPERTIES
    IMPORTED_LOCATION ${TORQUESCOPE_ARCHIVE_matio} INTERFACE_LINK_LIBRARIES hdf5::hdf5)
  set_target_properties(PkgConfig::MATIO PROPERTIES INTERFACE_LINK_LIBRARIES torquescope::matio)
  set_target_properties(hdf5::hdf5 PROPERTIES
    IMPORTED_LOCATION ${TORQUESCOPE_ARCHIVE_hdf5}
    INTERFACE_LINK_LIBRARIES "torquescope::sz;ZLIB::ZLIB;m;${CMAKE_DL_LIBS}")
  # FindZLIB may have set one location per configuration
  set_target_properties(ZLIB::ZLIB PROPERTIES
    IMPORTED_CONFIGURATIONS "" IMPORTED_LOCATION ${TORQUESCOPE_ARCHIVE_z}
    IMPORTED_LOCATION_RELEASE ${TORQUESCOPE_ARCHIVE_z} IMPORTED_LOCATION_DEBUG ${TORQUESCOPE_ARCHIVE_z})
  set_target_properties(OpenSSL::Crypto PROPERTIES
    IMPORTED_LOCATION ${TORQUESCOPE_ARCHIVE_crypto} INTERFACE_LINK_LIBRARIES "Threads::Threads;${CMAKE_DL_LIBS}")
endfunction()

if(TORQUESCOPE_STATIC_LIBRARIES)
  link_statically()
endif()
