# For fuzzing: the CSV library takes 48 MB for each file it opens, which under the address sanitizer lets a fuzzer read thirty files a second. The same
# library with blocks of 64 KB, ahead of the installed one, lets it read thousands, and has it cross the borders of blocks.
find_file(VISCONTACT_CSV_HEADER libfccp/csv.h REQUIRED)
file(READ ${VISCONTACT_CSV_HEADER} header)
string(REPLACE "block_len = 1<<24" "block_len = 1<<16" header_of_small_blocks "${header}")
if(header_of_small_blocks STREQUAL header)
  message(FATAL_ERROR "${VISCONTACT_CSV_HEADER} does not say block_len = 1<<24 any more")
endif()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/small_csv_blocks/libfccp/csv.h CONTENT "${header_of_small_blocks}" @ONLY)
include_directories(BEFORE SYSTEM ${PROJECT_BINARY_DIR}/small_csv_blocks)
