# What `cmake --install` puts where. The parts (COMPONENT) become Debian packages: see debian.cmake.
#   tool: the programs, with manual page and completion;  dev: what is compiled and linked against;  lib: shared libraries
include(CMakePackageConfigHelpers)

set_target_properties(prohull PROPERTIES
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
install(TARGETS prohull EXPORT prohullTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT lib NAMELINK_COMPONENT dev)
install(DIRECTORY include/prohull DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
if(TARGET prohull_import)  # the libraries run it
  install(TARGETS prohull_import RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR} COMPONENT tool)
endif()

# --- find_package(prohull) ---
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/prohull)
install(EXPORT prohullTargets NAMESPACE prohull:: DESTINATION ${package_dir} COMPONENT dev)
configure_package_config_file(cmake/prohullConfig.cmake.in prohullConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(prohullConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/prohullConfig.cmake ${PROJECT_BINARY_DIR}/prohullConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT dev)

# --- pkg-config; paths are relative to the file, so that the tree can be moved ---
file(RELATIVE_PATH pc_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" pc_prefix ${pc_prefix})
file(RELATIVE_PATH pc_libdir ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_LIBDIR})
file(RELATIVE_PATH pc_includedir ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
set(pc_private "")  # an archive does not say what it needs, so that all who link it have to
if(BUILD_SHARED_LIBS)
  set(pc_private .private)
endif()
configure_file(cmake/prohull.pc.in prohull.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/prohull.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)

if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()

# --- the command line; its manual page and completion are written by itself ---
if(BUILD_SHARED_LIBS AND NOT CMAKE_INSTALL_FULL_LIBDIR IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES)
  file(RELATIVE_PATH from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(prohull_cli PROPERTIES INSTALL_RPATH $ORIGIN/${from_bin})
endif()
install(TARGETS prohull_cli prohull_check prohull_check_motion RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tool)

set(shell ${PROJECT_BINARY_DIR}/share)
file(MAKE_DIRECTORY ${shell})
add_custom_command(OUTPUT ${shell}/prohull.1.gz ${shell}/prohull ${shell}/_prohull ${shell}/prohull.fish
  COMMAND prohull_cli manual > prohull.1
  COMMAND gzip -9nf prohull.1
  COMMAND prohull_cli completion bash > prohull
  COMMAND prohull_cli completion zsh > _prohull
  COMMAND prohull_cli completion fish > prohull.fish
  WORKING_DIRECTORY ${shell} COMMENT "Writing the manual page and the completion of shells" VERBATIM)
add_custom_target(prohull_shell ALL DEPENDS ${shell}/prohull.1.gz)
install(FILES ${shell}/prohull.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tool)
install(FILES ${shell}/prohull DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT tool)
install(FILES ${shell}/_prohull DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT zsh)
install(FILES ${shell}/prohull.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT tool)

include(cmake/debian.cmake)
