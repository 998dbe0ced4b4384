# The target coverage_report (preset coverage-report) prints a table of the lines that the tests
# have run so far. The table does not count tests and benchmarks, because they are not under test;
# FreeFEM scripts, because gcov reads only C++; and nodes of Slurm and other processes that end
# without exit(), because they write no counts. The test preset leaves out tests that kill the
# program at a random moment or limit the size of its files. They can damage a file of counts, and
# gcov then refuses this file, which also has the counts of later tests.
find_program(VISCONTACT_GCOVR gcovr)
add_custom_target(coverage_report
  COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C ${VISCONTACT_GCOVR}
          --root ${PROJECT_SOURCE_DIR} --object-directory ${PROJECT_BINARY_DIR}
          --exclude .*/tests/.* --exclude .*/bench/.* --exclude .*/build/.*
          --exclude-throw-branches -j 2 --json-summary ${PROJECT_BINARY_DIR}/coverage.json
          --txt ${PROJECT_BINARY_DIR}/coverage.txt
  COMMAND sh ${PROJECT_SOURCE_DIR}/cmake/coverage_table ${PROJECT_BINARY_DIR}/coverage.json
  VERBATIM)
