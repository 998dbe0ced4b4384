# Joins sources of tests into the file `output`, so that they are compiled as one:
#
#   awk -v output=FILE -v name=NAME -f join_sources.awk SOURCE...
#
# Each unnamed namespace gets the name NAME_1, NAME_2, ..., because helpers of the same name in the
# unnamed namespaces of two sources would otherwise collide. NAME must differ from that of other
# joined files of the program. Compilers and GoogleTest still name the sources and their lines.
FNR == 1 {
  ++number
  print "#line 1 \"" FILENAME "\"" >output
}
{
  sub(/^namespace \{$/, "namespace " name "_" number " {")
  print >output
}
