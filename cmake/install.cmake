# What is installed: libraries and headers with a CMake package (one component a library) and pkg-config files, the
# program, and the program it reads foreign files with. The tree may be moved as a whole.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev) # components are packages: see package.cmake
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/sbfmt)

set(SBFMT_COMPONENTS)
foreach(component core mechanics format interchange runtime)
  if(TARGET sbfmt::${component})
    list(APPEND SBFMT_COMPONENTS ${component})
    get_target_property(target sbfmt::${component} ALIASED_TARGET)
    # An export set of its own, so that a project which asks for the runtime meets nothing of the others.
    install(TARGETS ${target} EXPORT sbfmt-${component}
      RUNTIME COMPONENT runtime LIBRARY COMPONENT runtime NAMELINK_COMPONENT dev ARCHIVE COMPONENT dev)
    install(EXPORT sbfmt-${component} NAMESPACE sbfmt:: FILE sbfmt-${component}.cmake DESTINATION ${package_folder})
  endif()
endforeach()

if(SBFMT_RUNTIME_ONLY)
  set(sdk_headers PATTERN io.h EXCLUDE PATTERN validate.h EXCLUDE PATTERN build.h EXCLUDE PATTERN materials.h EXCLUDE PATTERN convert.h EXCLUDE PATTERN export.h EXCLUDE)
endif()
install(DIRECTORY libsbfmt/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN *.h ${sdk_headers})
install(DIRECTORY runtime/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN *.h)

# All of it, without tests and benchmarks.
add_custom_target(products)
foreach(component IN LISTS SBFMT_COMPONENTS)
  add_dependencies(products sbfmt::${component})
endforeach()
if(TARGET sbfmt)
  add_dependencies(products sbfmt)
  install(TARGETS sbfmt COMPONENT tools)
  if(CMAKE_SYSTEM_NAME STREQUAL Linux) # desktops open files with the program, and show pictures of them
    install(FILES tools/desktop/sbfmt.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT tools)
    install(FILES tools/desktop/sbfmt.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages COMPONENT tools)
    install(FILES tools/desktop/sbfmt.thumbnailer DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers COMPONENT tools)
    install(FILES tools/desktop/application-x-sbf.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/mimetypes COMPONENT tools)
  endif()
endif()
if(NOT SBFMT_RUNTIME_ONLY AND BUILD_SHARED_LIBS)
  # A folder to put on PYTHONPATH; it finds the library by itself where that is beside or in the system's places.
  install(DIRECTORY exporters/python/sbfmt DESTINATION ${CMAKE_INSTALL_DATADIR}/sbfmt/python
    COMPONENT runtime FILES_MATCHING PATTERN *.py)
endif()
if(TARGET sbfmt-web)
  add_dependencies(products sbfmt-web) # which `sbfmt export -o PAGE.html` makes pages of
  install(DIRECTORY ${PROJECT_BINARY_DIR}/web/ DESTINATION ${CMAKE_INSTALL_DATADIR}/sbfmt/web COMPONENT tools
    FILES_MATCHING PATTERN sbfmt.* PATTERN viewer* PATTERN modules/*.js)
endif()
if(TARGET sbfmt-manual)
  add_dependencies(products sbfmt-manual)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/generated/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
  install(FILES ${PROJECT_BINARY_DIR}/generated/bash/sbfmt DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    COMPONENT tools)
  install(FILES ${PROJECT_BINARY_DIR}/generated/zsh/_sbfmt DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions
    COMPONENT tools)
  install(FILES ${PROJECT_BINARY_DIR}/generated/fish/sbfmt.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
    COMPONENT tools)
endif()
if(TARGET sbfmt-import)
  add_dependencies(products sbfmt-import)
  install(TARGETS sbfmt-import RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/sbfmt COMPONENT tools)
endif()
if(WIN32 AND TARGET sbfmt-for-python)
  # The SDK as one DLL, with a CMake package of the same components.
  add_dependencies(products sbfmt-for-python)
  set_target_properties(sbfmt-for-python PROPERTIES EXCLUDE_FROM_ALL OFF)
  install(TARGETS sbfmt-for-python RUNTIME COMPONENT sdk ARCHIVE COMPONENT sdk)
  install(FILES ${PROJECT_BINARY_DIR}/exporters/sbfmt-interchange.def DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT sdk)
  install(DIRECTORY libsbfmt/include/ runtime/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT sdk FILES_MATCHING PATTERN *.h)
  install(FILES cmake/windows/sbfmtConfig.cmake DESTINATION ${package_folder} COMPONENT sdk)
  install(FILES ${PROJECT_BINARY_DIR}/package/sbfmtConfigVersion.cmake DESTINATION ${package_folder} COMPONENT sdk)
  if(SBFMT_STATIC_LIBRARIES AND TARGET sbfmt)
    install(FILES ${SBFMT_STATIC_LIBRARIES}/bin/SDL2.dll DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
  endif()
endif()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(cmake/sbfmtConfig.cmake.in ${PROJECT_BINARY_DIR}/package/sbfmtConfig.cmake
  INSTALL_DESTINATION ${package_folder} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/sbfmtConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/sbfmtConfig.cmake ${PROJECT_BINARY_DIR}/package/sbfmtConfigVersion.cmake
  DESTINATION ${package_folder})

# pkg-config. A static library's needs are its user's needs; a shared one keeps them to itself. `unnamed` are needs that
# have no file of pkg-config's.
set(private "")
if(BUILD_SHARED_LIBS)
  set(private .private)
endif()
file(RELATIVE_PATH PREFIX_FROM_PC ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
function(install_pc name description libraries requires unnamed)
  set(PC_NAME ${name})
  set(PC_DESCRIPTION ${description})
  set(PC_LIBS ${libraries})
  set(PC_NEEDS "Requires${private}: ${requires}\nLibs${private}:${unnamed} -lm")
  if(NOT private)
    set(PC_NEEDS "Requires: ${requires}")
    string(APPEND PC_LIBS "${unnamed} -lm")
  endif()
  configure_file(cmake/package.pc.in ${PROJECT_BINARY_DIR}/package/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/package/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
install_pc(sbrun "Brings soft-bodied characters of the sbfmt format to life"
  "-lsbrun -lsbfmt-mechanics -lsbfmt-core" "zlib" "")
if(NOT SBFMT_RUNTIME_ONLY)
  install_pc(sbfmt "Reads, checks, builds and converts soft-bodied characters of the sbfmt format"
    "-lsbfmt-interchange -lsbfmt-format -lsbfmt-mechanics -lsbfmt-core" "zlib libxml-2.0 qhull_r" " -lmeshoptimizer")
endif()
