# SPDX-License-Identifier: Apache-2.0
# Compiler settings shared by every target, and the third-party libraries.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
find_program(CCACHE ccache)
if(CCACHE)
  # What was compiled in another checkout is known here too.
  set(CMAKE_CXX_COMPILER_LAUNCHER env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" CCACHE_NOHASHDIR=1
    "${CCACHE}")
endif()

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(xsimd REQUIRED)
set_property(TARGET xsimd PROPERTY INTERFACE_LINK_LIBRARIES "")  # Debian's names xtl, which only complex numbers need
# The CMake packages of these, as Debian ships them, are missing, unusable or demand their tools too:
# pkg-config knows them. Targets: PkgConfig::OpenEXR, PkgConfig::OpenImageIO, ...
pkg_check_modules(OpenEXR REQUIRED IMPORTED_TARGET OpenEXR)
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(OpenColorIO REQUIRED IMPORTED_TARGET OpenColorIO)
pkg_check_modules(Zstandard REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(Deflate REQUIRED IMPORTED_TARGET libdeflate)
pkg_check_modules(PugiXml REQUIRED IMPORTED_TARGET pugixml)

# Warnings, instruction set and floating-point contract of our own code.
# No -ffast-math: NaN keeps meaning NaN, and fused operations are written as fma.
add_library(kiln_flags INTERFACE)
target_compile_options(kiln_flags INTERFACE
  -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wno-psabi -march=${KILN_ARCH}
  -fno-math-errno -fno-trapping-math -ffp-contract=off)
if(KILN_SANITIZE)
  target_compile_options(kiln_flags INTERFACE -fsanitize=${KILN_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  target_link_options(kiln_flags INTERFACE -fsanitize=${KILN_SANITIZE})
endif()
