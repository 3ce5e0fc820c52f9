# Debian packages: cpack -G DEB. prohull: the command line; libprohull-dev: headers and libraries to link;
# libprohull0.1: the shared libraries, with BUILD_SHARED_LIBS; python3-prohull: the Python package, for Debian's Python.
find_program(PROHULL_DPKG_SHLIBDEPS dpkg-shlibdeps)
find_program(PROHULL_FILE file)  # CPack asks it what is a program
if(NOT PROHULL_DPKG_SHLIBDEPS OR NOT PROHULL_FILE)
  message(STATUS "prohull: Debian packages: off, they need dpkg-dev and file")
  return()
endif()
message(STATUS "prohull: Debian packages: on, by cpack -G DEB")

# Who makes the packages maintains them, and says who that is as for all of Debian's tools.
set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
if(NOT maintainer MATCHES "^[^ ].* <.+@.+>$")
  set(maintainer "The prohull authors <prohull@localhost>")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT ${maintainer})
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL tool dev)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# The documents that each package has to bring.
set(documents ${PROJECT_BINARY_DIR}/debian)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS CHANGELOG.md)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH, where that is set
configure_file(cmake/debian/changelog.in ${documents}/changelog.Debian @ONLY)
configure_file(CHANGELOG.md ${documents}/changelog COPYONLY)
configure_file(cmake/debian/copyright ${documents}/copyright COPYONLY)
execute_process(COMMAND gzip -9nfk changelog changelog.Debian WORKING_DIRECTORY ${documents} COMMAND_ERROR_IS_FATAL ANY)

# package(COMPONENT NAME SECTION DESCRIPTION [DEPENDS...])
macro(package component name section description)
  string(TOUPPER ${component} key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${key}_DESCRIPTION ${description})
  set(CPACK_DEBIAN_${key}_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS ${ARGN})
  install(FILES ${documents}/copyright ${documents}/changelog.gz ${documents}/changelog.Debian.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
endmacro()

set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # CPack would put it before each description
set(what_it_is "prohull simplifies a triangle mesh, whatever its defects, to a hull of
as many faces as asked for, with an exact certificate that no point of
the original sticks out; or to one that the original encloses. For
collision geometry of robots, occluders and shadow proxies, cages, and
queries on heavy scans.
")
package(tool prohull graphics "hulls that provably enclose a triangle mesh - command line
${what_it_is}
This package has the command line.")
install(FILES ${PROJECT_BINARY_DIR}/share/_prohull
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT tool EXCLUDE_FROM_ALL)

package(dev libprohull-dev libdevel "hulls that provably enclose a triangle mesh - C++ library
${what_it_is}
This package has what programs in C++20 are compiled and linked with."
"libfmt-dev, libminizip-dev, libtbb-dev, libzstd-dev, zlib1g-dev, pkg-config")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS prohull)  # prohull-import, which the library runs

if(BUILD_SHARED_LIBS)
  list(APPEND CPACK_COMPONENTS_ALL lib)
  set(version ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  package(lib libprohull${version} libs "hulls that provably enclose a triangle mesh - shared library
${what_it_is}
This package has the shared library.")
  set(CPACK_DEBIAN_LIB_PACKAGE_RECOMMENDS prohull)
  file(WRITE ${documents}/triggers "activate-noawait ldconfig\n")
  file(WRITE ${documents}/shlibs "libprohull ${version} libprohull${version} (>= ${PROJECT_VERSION})\n")
  set(CPACK_DEBIAN_LIB_PACKAGE_CONTROL_EXTRA ${documents}/triggers ${documents}/shlibs)
  set(CPACK_COMPONENT_DEV_DEPENDS lib)
  set(CPACK_COMPONENT_TOOL_DEPENDS lib)
  set(CPACK_COMPONENT_PYTHON_DEPENDS lib)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src)
endif()

if(TARGET prohull_python AND Python_EXECUTABLE STREQUAL /usr/bin/python3)
  list(APPEND CPACK_COMPONENTS_ALL python)
  find_package(Python QUIET COMPONENTS Interpreter)
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  package(python python3-prohull python "hulls that provably enclose a triangle mesh - Python
${what_it_is}
This package has the module for Python." "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS prohull)
  set(site lib/python3/dist-packages/prohull)
  install(TARGETS prohull_python LIBRARY DESTINATION ${site} COMPONENT python EXCLUDE_FROM_ALL)
  install(DIRECTORY python/prohull/ DESTINATION ${site} COMPONENT python EXCLUDE_FROM_ALL
          FILES_MATCHING PATTERN *.py PATTERN *.pyi PATTERN py.typed PATTERN __pycache__ EXCLUDE)
  file(CREATE_LINK ../../../../bin/prohull ${documents}/prohull SYMBOLIC)  # for python3 -m prohull
  install(FILES ${documents}/prohull DESTINATION ${site} COMPONENT python EXCLUDE_FROM_ALL)
endif()

include(CPack)
