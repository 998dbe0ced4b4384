# Writes a C++ file OUTPUT whose functions, declared in HEADER, return the texts of files:
#   cmake -D OUTPUT=... -D HEADER=... "-D TEXTS=name=file|name=file" -P embed_texts.cmake
set(code "// Generated from files by report/embed_texts.cmake.\n#include \"${HEADER}\"\n\nnamespace viscontact::report {\n")
string(REPLACE "|" ";" pairs "${TEXTS}")
foreach(pair IN LISTS pairs)
  string(REPLACE "=" ";" parts "${pair}")
  list(GET parts 0 name)
  list(GET parts 1 file)
  file(READ "${file}" text)
  string(APPEND code "std::string_view ${name}() {\n  return R\"EMBEDDED(${text})EMBEDDED\";\n}\n")
endforeach()
string(APPEND code "}  // namespace viscontact::report\n")
file(WRITE "${OUTPUT}" "${code}")
