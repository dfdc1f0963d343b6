# Debian packages of what is built: `cpack --config build/ci/CPackConfig.cmake -B out/packages` writes vitrine (the
# program), vitrine-plugins (the built-in garments and necklines) and vitrine-sdk (headers, starter, docs).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME vitrine)
set(CPACK_PACKAGE_VENDOR "the Vitrine authors")
set(CPACK_PACKAGE_CONTACT "the Vitrine authors <vitrine@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL host sdk plugins)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Packing takes what is built; it does not build tests and benchmarks first.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS ${CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS})

# CPack would put any other summary above each package's own first line.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${CMAKE_PROJECT_NAME} built using CMake")

set(same "(= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_HOST_PACKAGE_NAME vitrine)
set(CPACK_DEBIAN_HOST_DESCRIPTION "${PROJECT_DESCRIPTION}
Turns a front and a back photo of a garment into a textured 3D garment on a
mannequin, one item or a whole catalogue.")
set(CPACK_DEBIAN_HOST_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_HOST_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_HOST_PACKAGE_DEPENDS "vitrine-plugins ${same}")
set(CPACK_DEBIAN_HOST_PACKAGE_SUGGESTS "vitrine-sdk ${same}")

set(CPACK_DEBIAN_PLUGINS_PACKAGE_NAME vitrine-plugins)
set(CPACK_DEBIAN_PLUGINS_DESCRIPTION "Garments and necklines for Vitrine
The garment types and necklines that come with Vitrine, as plugins of data.")
set(CPACK_DEBIAN_PLUGINS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PLUGINS_PACKAGE_SHLIBDEPS ON)

set(CPACK_DEBIAN_SDK_PACKAGE_NAME vitrine-sdk)
set(CPACK_DEBIAN_SDK_DESCRIPTION "Headers and starter for writing Vitrine plugins
The plugin ABI ${VITRINE_ABI_VERSION}, a C++20 wrapper that checks tables when they are
compiled, CMake functions, and the project that a new plugin starts from.")
set(CPACK_DEBIAN_SDK_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_SDK_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_SDK_PACKAGE_RECOMMENDS "vitrine ${same}, cmake (>= 3.25), ninja-build | make, g++ | c++-compiler")
include(CPack)
