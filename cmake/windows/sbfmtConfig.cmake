# The CMake package of the SDK for Windows: find_package(sbfmt COMPONENTS runtime ...) as elsewhere. Every component is the one DLL.
get_filename_component(sbfmt_root "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET sbfmt::sdk)
  add_library(sbfmt::sdk SHARED IMPORTED)
  set_target_properties(sbfmt::sdk PROPERTIES IMPORTED_LOCATION "${sbfmt_root}/bin/sbfmt-interchange.dll"
    IMPORTED_IMPLIB "${sbfmt_root}/lib/sbfmt-interchange.dll.a" INTERFACE_INCLUDE_DIRECTORIES "${sbfmt_root}/include")
  foreach(component core mechanics format interchange runtime)
    add_library(sbfmt::${component} INTERFACE IMPORTED)
    set_target_properties(sbfmt::${component} PROPERTIES INTERFACE_LINK_LIBRARIES sbfmt::sdk)
  endforeach()
endif()
unset(sbfmt_root)
