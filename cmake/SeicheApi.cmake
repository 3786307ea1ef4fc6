# The C++ interface as pages of Doxygen: `cmake --build build/release --target api` writes build/api/html. mkdocs copies
# them into its site.
find_program(DOXYGEN_EXECUTABLE doxygen)
set(api_folder ${CMAKE_SOURCE_DIR}/build/api CACHE INTERNAL "where the target api writes")
if(DOXYGEN_EXECUTABLE)
  set(API_PROJECT ${CMAKE_CURRENT_SOURCE_DIR})
  set(API_VERSION ${PROJECT_VERSION})
  configure_file(${CMAKE_CURRENT_SOURCE_DIR}/cmake/Doxyfile.in ${CMAKE_CURRENT_BINARY_DIR}/Doxyfile @ONLY)
  add_custom_target(api
    COMMAND ${CMAKE_COMMAND} -E make_directory ${api_folder}
    COMMAND ${CMAKE_COMMAND} -E env API_OUTPUT=${api_folder} ${DOXYGEN_EXECUTABLE} ${CMAKE_CURRENT_BINARY_DIR}/Doxyfile
    COMMENT "C++ interface: ${api_folder}/html/index.html" VERBATIM)
else()
  add_custom_target(api
    COMMAND ${CMAKE_COMMAND} -E echo "doxygen is missing: install Debian's package doxygen and configure again"
    COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
endif()
