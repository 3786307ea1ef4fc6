# Installs the program, the libraries with their headers, and the files by which find_package(Seiche) finds them.
include(CMakePackageConfigHelpers)

set(seiche_config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Seiche)

install(TARGETS seiche RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
foreach(layer base grid geometry linalg levelset fluid solid coupling files scene run render info exporting validate all)
  if(TARGET seiche_${layer})
    install(TARGETS seiche_${layer} EXPORT SeicheTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  endif()
endforeach()
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/seiche FILES_MATCHING PATTERN "*.h")
install(EXPORT SeicheTargets NAMESPACE Seiche:: DESTINATION ${seiche_config_folder})

configure_package_config_file(cmake/SeicheConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/SeicheConfig.cmake
  INSTALL_DESTINATION ${seiche_config_folder})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/SeicheConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/SeicheConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/SeicheConfigVersion.cmake
  cmake/SeicheDependencies.cmake DESTINATION ${seiche_config_folder})
install(DIRECTORY validation scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/seiche)  # as `seiche validate` looks for them
# Scripts for other programs; each finds share/seiche/common beside its own folder.
install(DIRECTORY share/ DESTINATION ${CMAKE_INSTALL_DATADIR}/seiche FILES_MATCHING PATTERN "*.py"
  PATTERN "__pycache__" EXCLUDE)
install(FILES LICENSE NOTICE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
