# viscontact_module(NAME SOURCES FILE... [NEEDS PART...] [LIBRARIES LIBRARY...])
#
# Adds the module NAME, a shared library lib/viscontact/NAME-VERSION.so that the program loads when it
# first calls a function of it (common/system/module.hpp). In the build tree the folder is beside the
# program, and after installation beside the folder of the program.
#
# NEEDS      parts of Viscontact that the module contains
# LIBRARIES  external libraries
function(viscontact_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;NEEDS;LIBRARIES")
  set(target viscontact_${name}_module)
  add_library(${target} MODULE ${arg_SOURCES})
  set_target_properties(${target} PROPERTIES
    PREFIX "" OUTPUT_NAME ${name}-${PROJECT_VERSION}
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/viscontact)
  target_include_directories(${target} PRIVATE ${VISCONTACT_INCLUDE_FOLDER})
  list(TRANSFORM arg_NEEDS PREPEND viscontact_ OUTPUT_VARIABLE parts)
  target_link_libraries(${target} PRIVATE ${parts} ${arg_LIBRARIES} viscontact_warnings)
  # Only functions of the module's own sources are visible outside, which shortens its loading.
  target_link_options(${target} PRIVATE LINKER:--exclude-libs,ALL)
  install(TARGETS ${target} LIBRARY DESTINATION lib/viscontact)
  set_property(GLOBAL APPEND PROPERTY VISCONTACT_MODULES ${target})
endfunction()
