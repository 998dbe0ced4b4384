# Joins sources of tests into the file `output`, so that they are compiled as one:
#
#   awk -v output=FILE -f join_sources.awk SOURCE...
#
# Each unnamed namespace gets a name of its own, because helpers of the same name in the unnamed
# namespaces of two sources would otherwise collide. Compilers and GoogleTest still name the sources
# and their lines.
FNR == 1 {
  ++number
  print "#line 1 \"" FILENAME "\"" >output
}
{
  sub(/^namespace \{$/, "namespace source_" number " {")
  print >output
}
