# Installs the CMake package, builds programs with it, and one with its sources, in the working directory:
#     cmake -DROOT=<checkout> -DVERSION=<the library's> -DCARGO=<program> -DBUILT=<folder of the library> -P test.cmake
cmake_minimum_required(VERSION 3.20)
# The features of the tests' build, so that cargo finds the library built.
get_filename_component(target "${BUILT}" DIRECTORY)
get_filename_component(profile "${BUILT}" NAME)
string(REPLACE debug dev profile "${profile}")
set(cargo "-DUNITVEC_CARGO=${CARGO}" "-DUNITVEC_CARGO_TARGET_DIR=${target}" -DUNITVEC_CARGO_PROFILE=${profile}
    "-DUNITVEC_CARGO_ARGUMENTS=--package unitvec-tests --features unitvec-tests/glsl")

function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE result)
  if(result)
    message(FATAL_ERROR "${ARGN}: ${result}\n${said}")
  endif()
endfunction()

run(cmake -S "${ROOT}/c" -B library ${cargo})
run(cmake --build library)
run(cmake --install library --prefix installed)
set(prefix "-DCMAKE_PREFIX_PATH=${CMAKE_CURRENT_BINARY_DIR}/installed")
run(cmake -S "${ROOT}/examples/c" -B found ${prefix})
run(cmake -S "${ROOT}/examples/c" -B part ${cargo} "-DUNITVEC_SOURCE=${ROOT}/c")
foreach(build found part)
  run(cmake --build ${build})
  run(${build}/normals)
endforeach()

# A codec costs a program a few kilobytes, though the library has all of them, and Rust's standard library.
run(cmake -S "${ROOT}/tests/c_abi/package" -B size ${prefix} -DCMAKE_EXE_LINKER_FLAGS=-s)
run(cmake --build size)
file(SIZE size/with with)
file(SIZE size/without without)
math(EXPR cost "${with} - ${without}")
if(cost GREATER 20000)
  message(FATAL_ERROR "a codec's functions cost ${cost} bytes")
endif()

# The version of vcpkg's port is written out.
file(READ "${ROOT}/c/packaging/vcpkg/vcpkg.json" port)
string(JSON version GET "${port}" version)
if(NOT version STREQUAL VERSION)
  message(FATAL_ERROR "vcpkg.json has the version ${version}, the library ${VERSION}")
endif()
