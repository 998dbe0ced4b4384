# embed_texts(NAMESPACE NAME=FILE[,FILE...]...)
#
# Makes page_texts.cpp in the build folder of the CMakeLists.txt that calls it. Its functions NAME()
# in viscontact::NAMESPACE return the text of a file; the source that uses them declares them.
# Several files with one name are a script. They are joined in the order given within one function
# of JavaScript, so that they share their names, and no other script of the page sees these.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  function(embed_texts namespace)
    set(files ${ARGN})
    list(TRANSFORM files REPLACE "^[^=]*=" "")
    string(REPLACE "," ";" files "${files}")
    list(JOIN ARGN "|" texts)
    add_custom_command(
      OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/page_texts.cpp
      COMMAND ${CMAKE_COMMAND} -D OUTPUT=${CMAKE_CURRENT_BINARY_DIR}/page_texts.cpp
              -D NAMESPACE=${namespace} -D FOLDER=${CMAKE_CURRENT_SOURCE_DIR}
              "-D TEXTS=${texts}" -P ${PROJECT_SOURCE_DIR}/report/embed_texts.cmake
      DEPENDS ${files} ${PROJECT_SOURCE_DIR}/report/embed_texts.cmake
      VERBATIM)
  endfunction()
  return()
endif()

set(code "// Generated from files by report/embed_texts.cmake.\n")
string(APPEND code "#include <string_view>\n\nnamespace viscontact::${NAMESPACE} {\n")
string(REPLACE "|" ";" pairs "${TEXTS}")
foreach(pair IN LISTS pairs)
  string(REPLACE "=" ";" parts "${pair}")
  list(GET parts 0 name)
  list(GET parts 1 files)
  string(REPLACE "," ";" files "${files}")
  set(text "")
  foreach(file IN LISTS files)
    file(READ "${FOLDER}/${file}" part)
    string(APPEND text "${part}")
  endforeach()
  list(LENGTH files count)
  if(count GREATER 1)
    set(text "'use strict';\n(() => {\n${text}})();\n")
  endif()
  string(APPEND code "std::string_view ${name}() {\n  return R\"EMBEDDED(${text})EMBEDDED\";\n}\n")
endforeach()
string(APPEND code "}  // namespace viscontact::${NAMESPACE}\n")
file(WRITE "${OUTPUT}" "${code}")
