# Every library the engine links, in one place. All are Debian packages (scripts/install-deps).

# a compiler cache makes the second build fast; nothing depends on it
find_program(TORQUESCOPE_CCACHE ccache)
if(TORQUESCOPE_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${TORQUESCOPE_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${TORQUESCOPE_CCACHE})
endif()

find_package(Threads REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(PkgConfig REQUIRED)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
pkg_check_modules(MATIO REQUIRED IMPORTED_TARGET matio)
pkg_check_modules(URDFDOM REQUIRED IMPORTED_TARGET urdfdom)
set(HDF5_PREFER_PARALLEL OFF)
find_package(HDF5 1.10 REQUIRED COMPONENTS C)
find_path(TOMLPLUSPLUS_INCLUDE_DIR toml++/toml.h REQUIRED)
