# viscontact_library(NAME SOURCES FILE... [HEADERS FILE...] [NEEDS PART...] [LOADS PART...]
#                    [FIND PACKAGE...] [PUBLIC LIBRARY...] [PRIVATE LIBRARY...] [COMPUTES_LITTLE])
#
# Adds a part of Viscontact that can be used on its own, as the targets viscontact_NAME and
# viscontact::NAME. Paths of files are relative to the folder of the CMakeLists.txt that calls it.
#
# HEADERS  public headers, which are installed; all other headers are internal
# NEEDS    parts of Viscontact that the part links to
# LOADS    parts PART that the part links to, too, but which the program loads as modules: a target with
#          the property VISCONTACT_LOADS_MODULES links PART_loader in place of PART
# FIND     arguments of find_dependency, one string for each package, for projects that use the part
#          through find_package(viscontact COMPONENTS NAME)
# PUBLIC   external libraries whose headers the public headers include
# PRIVATE  external libraries that only the sources of the part use
# COMPUTES_LITTLE  the part reads cases, waits for FreeFEM, prints, draws and calls the parts that
#          compute, so it needs no -O3: in the preset release it is compiled with -O1, which takes
#          two thirds of the time
#
# A part without HEADERS is used by the program alone and is not installed.
function(viscontact_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "COMPUTES_LITTLE" ""
                        "SOURCES;HEADERS;NEEDS;LOADS;FIND;PUBLIC;PRIVATE")
  set(target viscontact_${name})
  add_library(${target} STATIC ${arg_SOURCES})
  add_library(viscontact::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name} ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_compile_features(${target} PUBLIC cxx_std_20)
  # The Python module is a shared library, which contains the parts. They are compiled for it in any
  # case, so that VISCONTACT_PYTHON compiles nothing twice. Without semantic interposition, the
  # compiler may still expand functions of a part in place.
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE -fno-semantic-interposition)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${VISCONTACT_INCLUDE_FOLDER}>
                             $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  list(TRANSFORM arg_NEEDS PREPEND viscontact_ OUTPUT_VARIABLE parts)
  set(loads_modules $<BOOL:$<TARGET_PROPERTY:VISCONTACT_LOADS_MODULES>>)
  foreach(part IN LISTS arg_LOADS)
    list(APPEND parts
      $<BUILD_INTERFACE:$<IF:${loads_modules},viscontact_${part}_loader,viscontact_${part}>>
      $<INSTALL_INTERFACE:viscontact::${part}>)
  endforeach()
  target_link_libraries(${target} PUBLIC ${parts} ${arg_PUBLIC}
                        PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:viscontact_warnings>)
  if(arg_COMPUTES_LITTLE)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  if(NOT arg_HEADERS)
    return()
  endif()

  install(TARGETS ${target} EXPORT viscontact-${name} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  foreach(header IN LISTS arg_HEADERS)
    cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR}
               OUTPUT_VARIABLE folder)
    cmake_path(GET header PARENT_PATH below)
    install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/viscontact/${folder}/${below})
  endforeach()
  install(EXPORT viscontact-${name} NAMESPACE viscontact:: FILE viscontact-${name}-targets.cmake
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/viscontact)
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR}
             OUTPUT_VARIABLE folder)
  list(TRANSFORM arg_HEADERS PREPEND viscontact/${folder}/ OUTPUT_VARIABLE headers)
  # These variables describe the part in viscontact-config.cmake.in.
  list(JOIN arg_FIND "\" \"" find)
  string(APPEND description "set(viscontact_${name}_needs ${arg_NEEDS} ${arg_LOADS})\n")
  string(APPEND description "set(viscontact_${name}_find \"${find}\")\n")
  string(APPEND description "set(viscontact_${name}_headers ${headers})\n")
  set_property(GLOBAL APPEND PROPERTY VISCONTACT_PARTS ${name})
  set_property(GLOBAL APPEND_STRING PROPERTY VISCONTACT_PART_DESCRIPTIONS "${description}")
endfunction()
