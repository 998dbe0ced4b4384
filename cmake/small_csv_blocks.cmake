# For fuzzing: makes a copy of the CSV library that reads blocks of 64 KB, and puts it before the
# installed library. The installed library allocates 48 MB for each file that it opens; with the
# address sanitizer, a fuzzer then reads only thirty files a second. With small blocks it reads
# thousands.
find_file(VISCONTACT_CSV_HEADER libfccp/csv.h REQUIRED)
file(READ ${VISCONTACT_CSV_HEADER} header)
string(REPLACE "block_len = 1<<24" "block_len = 1<<16" header_of_small_blocks "${header}")
if(header_of_small_blocks STREQUAL header)
  message(FATAL_ERROR "${VISCONTACT_CSV_HEADER} does not say block_len = 1<<24 any more")
endif()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/small_csv_blocks/libfccp/csv.h
     CONTENT "${header_of_small_blocks}" @ONLY)
include_directories(BEFORE SYSTEM ${PROJECT_BINARY_DIR}/small_csv_blocks)
