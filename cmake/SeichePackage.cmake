# Debian packages by `cpack --config build/release/CPackConfig.cmake`, into build/release/packages: seiche, the program,
# libseiche-dev, the static libraries, and with SEICHE_PYTHON python3-seiche, the module. The tools that cpack needs are under [package] in packages.txt.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME seiche)
set(CPACK_PACKAGE_VENDOR "The Seiche developers")
set(CPACK_PACKAGE_CONTACT "The Seiche developers")  # Debian's Maintainer
set(CPACK_PACKAGE_DIRECTORY "${CMAKE_BINARY_DIR}/packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program development)
if(SEICHE_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)

# Binaries with CGAL's meshing may be passed on under GPL-3 or later alone (NOTICE).
set(seiche_licence_note "Binaries are under GPL-3 or later, since they contain CGAL's meshing.
The source is under Apache-2.0.")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME seiche)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# OpenBLAS is named, for CHOLMOD's package is content with a BLAS of half the speed. Pictures need a font.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "openmpi-bin, libopenblas0-serial | libopenblas0 | libblas.so.3, fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS ffmpeg)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "Seiche simulates water and other liquids in 2D and 3D, with solids that float,
sink, collide and bend. One solve a step finds pressure and motion of all bodies.
Scenes are text files. Runs take one core or a cluster.
.
${seiche_licence_note}")

# Static libraries: programs that link them need the development packages that Seiche is built with.
file(STRINGS packages.txt seiche_development_packages REGEX "^(lib|nlohmann).*-dev([ #]|$)")
list(TRANSFORM seiche_development_packages REPLACE "[ #].*" "")
list(JOIN seiche_development_packages ", " seiche_development_packages)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libseiche-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${seiche_development_packages}")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "Static libraries and headers of Seiche. CMake projects find them by
find_package(Seiche).
.
${seiche_licence_note}")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-seiche)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy, libopenblas0-serial | libopenblas0 | libblas.so.3")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "Python module of Seiche: scenes, runs step by step, fields as NumPy arrays.
.
${seiche_licence_note}")

# Debian looks for the licence of each package here.
install(FILES cmake/copyright DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/seiche COMPONENT program)
install(FILES cmake/copyright DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/libseiche-dev COMPONENT development)
include(CPack)
