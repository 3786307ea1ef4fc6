# Installs two components. `program`: the program, its scenes, cases and pages. `development`: the libraries with their
# headers, and the files by which find_package(Seiche) finds them. `cmake --install` without --component installs both.
include(CMakePackageConfigHelpers)

set(seiche_config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Seiche)
if("$CACHE{CMAKE_INSTALL_DOCDIR}" STREQUAL "")  # else the user's own folder; the default has the project's capital
  set(CMAKE_INSTALL_DOCDIR ${CMAKE_INSTALL_DATAROOTDIR}/doc/seiche)
endif()

install(TARGETS seiche RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY validation scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/seiche  # as `seiche validate` looks for them
  COMPONENT program)
install(DIRECTORY share/ DESTINATION ${CMAKE_INSTALL_DATADIR}/seiche COMPONENT program  # for Blender and others
  FILES_MATCHING PATTERN "*.py" PATTERN "__pycache__" EXCLUDE)
install(FILES share/man/seiche.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES share/completions/seiche.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  RENAME seiche COMPONENT program)
install(FILES share/completions/_seiche DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(FILES share/completions/seiche.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
  COMPONENT program)
install(FILES CHANGELOG.md CITATION.cff CONTRIBUTING.md LICENSE NOTICE README.md SECURITY.md packages.txt
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES scenes/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/scenes COMPONENT program)  # README.md links to it

foreach(layer base grid geometry linalg levelset fluid solid coupling files scene run render charts info exporting validate all)
  if(TARGET seiche_${layer})
    install(TARGETS seiche_${layer} EXPORT SeicheTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
      COMPONENT development)
  endif()
endforeach()
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/seiche COMPONENT development
  FILES_MATCHING PATTERN "*.h")
install(EXPORT SeicheTargets NAMESPACE Seiche:: DESTINATION ${seiche_config_folder} COMPONENT development)

configure_package_config_file(cmake/SeicheConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/SeicheConfig.cmake
  INSTALL_DESTINATION ${seiche_config_folder})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/SeicheConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/SeicheConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/SeicheConfigVersion.cmake
  cmake/SeicheDependencies.cmake DESTINATION ${seiche_config_folder} COMPONENT development)
