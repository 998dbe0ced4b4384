# The target coverage_report (preset coverage-report): the lines that the tests have run so far, in a table.
# Left out: the tests and the benchmarks, which are not what is tested; the FreeFEM scripts, which gcov does not know; Slurm's nodes and other runs that
# end without exit(), which write no counts; by the test preset, the tests that kill the program at a random moment or let it write small files only:
# a file of counts that is torn so is refused from then on, with all that the later tests add to it.
find_program(VISCONTACT_GCOVR gcovr)
add_custom_target(coverage_report
  COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C ${VISCONTACT_GCOVR} --root ${PROJECT_SOURCE_DIR} --object-directory ${PROJECT_BINARY_DIR}
          --exclude .*/tests/.* --exclude .*/bench/.* --exclude .*/build/.* --exclude-throw-branches -j 2
          --json-summary ${PROJECT_BINARY_DIR}/coverage.json --txt ${PROJECT_BINARY_DIR}/coverage.txt
  COMMAND sh ${PROJECT_SOURCE_DIR}/cmake/coverage_table ${PROJECT_BINARY_DIR}/coverage.json
  VERBATIM)
