# What tests need to run under -fsanitize=thread (preset tsan); nothing in any other build.
#
# No OpenMP runtime is compiled with the sanitizer, so it cannot see that the end of a parallel region waits for its
# threads, and reports every correct program. libomp comes with archer, a tool that tells the sanitizer about the waits;
# with it, what happens inside libraries that are not instrumented (libomp itself, HDF5, libstdc++) has to be left out.
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=thread")
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "-fsanitize=thread needs clang and libomp (gcc's libgomp has no such tool): use preset tsan")
  endif()
  # beside libomp, where the loader does not look
  get_filename_component(openmp_folder "${OpenMP_omp_LIBRARY}" DIRECTORY)
  find_library(TORQUESCOPE_ARCHER archer HINTS "${openmp_folder}" REQUIRED)
  set(TORQUESCOPE_SANITIZER_ENVIRONMENT
    "OMP_TOOL_LIBRARIES=${TORQUESCOPE_ARCHER};TSAN_OPTIONS=ignore_noninstrumented_modules=1")
endif()
