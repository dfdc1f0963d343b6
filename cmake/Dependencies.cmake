# Every package the project uses, with the Debian 12 package that brings it. scripts/install-deps reads the
# "# debian:" lines of this file, so a dependency is named in one place only.

# CONFIG: CGAL ships a FindEigen3 of its own that would hide the Eigen3::Eigen target.
find_package(Eigen3 3.4 CONFIG REQUIRED)                             # debian: libeigen3-dev
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs)  # debian: libopencv-core-dev libopencv-imgproc-dev libopencv-imgcodecs-dev
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
find_package(CGAL 5.5 REQUIRED)                                      # debian: libcgal-dev
find_package(Boost 1.74 REQUIRED COMPONENTS filesystem system)       # debian: libboost-dev libboost-filesystem-dev libboost-system-dev
find_package(assimp 5.2 REQUIRED)                                    # debian: libassimp-dev
find_package(spdlog 1.10 REQUIRED)                                   # debian: libspdlog-dev
find_package(CLI11 2.1 REQUIRED)                                     # debian: libcli11-dev
find_package(nlohmann_json 3.11 REQUIRED)                            # debian: nlohmann-json3-dev
find_path(TINYGLTF_INCLUDE_DIR tiny_gltf.h REQUIRED)                 # debian: libtinygltf-dev
find_package(meshoptimizer CONFIG REQUIRED)                          # debian: libmeshoptimizer-dev
find_package(embree 3.13 REQUIRED)                                   # debian: libembree-dev
find_package(OpenSSL 3.0 REQUIRED COMPONENTS Crypto)                 # debian: libssl-dev
# Both read what strangers wrote: expat stops at a document type before it means anything, RE2 needs linear time.
find_package(expat 2.5 REQUIRED)                                     # debian: libexpat1-dev
find_library(RE2_LIBRARY re2 REQUIRED)                               # debian: libre2-dev
find_path(RE2_INCLUDE_DIR re2/re2.h REQUIRED)
find_library(HTTPLIB_LIBRARY cpp-httplib REQUIRED)                    # debian: libcpp-httplib-dev
find_path(HTTPLIB_INCLUDE_DIR httplib.h REQUIRED)
# Fetches the show room's viewer; scripts/install-deps installs it where there is none.
find_program(NPM_PROGRAM npm)
if(VITRINE_TESTS)
  find_package(GTest REQUIRED)                                       # debian: libgtest-dev libgmock-dev
  # Plugins are built by other people's tools. Where one is missing its tests are there and fail.
  find_program(VITRINE_GCC gcc)                                      # debian-test: g++
  find_program(VITRINE_GXX g++)
  find_program(VITRINE_CLANG clang)                                  # debian-test: clang
  find_program(VITRINE_CLANGXX clang++)                              # debian-test: libc++-dev libc++abi-dev
  find_program(VITRINE_DPKG_DEB dpkg-deb)                            # debian-test: dpkg-dev file
endif()
if(VITRINE_BENCHMARKS)
  find_package(benchmark REQUIRED)                                   # debian: libbenchmark-dev
  # Writes docs/ACCURACY.md from the tables of benchmarks/accuracy; its own library is all it needs.
  find_program(VITRINE_PYTHON python3)                               # debian: python3
  # A program to compare with; vitrine-bench leaves it out where it is not installed.
  find_library(GMSH_LIBRARY gmsh)                                    # debian-peer: libgmsh-dev
  find_path(GMSH_INCLUDE_DIR gmsh.h)
  # vitrine-bench drape --blender starts it; nothing is linked.
  find_program(BLENDER_PROGRAM blender)                              # debian-peer: blender
endif()
