# src/base/version.h's build_digest(): a digest of the sources that make what a run gives, of the compiler and of its
# flags. What judges, draws or describes runs does not count, so that runs made before still count for seiche validate.
set(counted "${CMAKE_BINARY_DIR}/digest_sources.txt")
file(GLOB_RECURSE run_sources CONFIGURE_DEPENDS src/*.cpp src/*.h)
list(FILTER run_sources EXCLUDE REGEX "/src/(validate|render|charts|info|exporting)/|/src/scene/docs[^/]*$")
list(APPEND run_sources "${CMAKE_CURRENT_SOURCE_DIR}/CMakeLists.txt" "${CMAKE_CURRENT_SOURCE_DIR}/cmake/SeicheDependencies.cmake")
list(SORT run_sources)
list(JOIN run_sources "\n" lines)
file(CONFIGURE OUTPUT "${counted}" CONTENT "${lines}\n" @ONLY)
set(digest_settings "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_SYSTEM_PROCESSOR}"
  "${CMAKE_BUILD_TYPE} ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_RELEASE} CHOLMOD ${SEICHE_CHOLMOD}")
list(JOIN digest_settings " " digest_settings)
add_custom_command(OUTPUT "${CMAKE_BINARY_DIR}/build_digest.cpp"
  COMMAND ${CMAKE_COMMAND} -DSOURCES=${counted} "-DSETTINGS=${digest_settings}"
    -DROOT=${CMAKE_CURRENT_SOURCE_DIR} -DOUTPUT=${CMAKE_BINARY_DIR}/build_digest.cpp
    -P "${CMAKE_CURRENT_SOURCE_DIR}/cmake/write_digest.cmake"
  DEPENDS ${run_sources} "${counted}" "${CMAKE_CURRENT_SOURCE_DIR}/cmake/write_digest.cmake"
  COMMENT "Digest of the sources" VERBATIM)
target_sources(seiche_base PRIVATE "${CMAKE_BINARY_DIR}/build_digest.cpp")
