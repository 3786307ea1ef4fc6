# Placeholder-free minimum: the program; the package part is added beside it.
install(TARGETS seiche RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
