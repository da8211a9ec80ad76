# Makes the manual page of a program from what it prints for --help.
# cmake -DHELP2MAN=... -DPROGRAM=... -DPAGE=... -DVERSION=... -P manual_page.cmake
execute_process(COMMAND ${PROGRAM} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
# The first sentence below the usage says what the program is for.
string(REGEX MATCH "\n\n([^\n].*)$" below_usage "${help}")
string(REGEX REPLACE "[ \n]+" " " text "${CMAKE_MATCH_1}")
string(REGEX MATCH "^[^.:(]*" summary "${text}")
string(SUBSTRING "${summary}" 0 1 first)
string(SUBSTRING "${summary}" 1 -1 rest)
string(TOLOWER "${first}" first)
execute_process(
  COMMAND ${HELP2MAN} --no-info --version-string ${VERSION} --name "${first}${rest}" --output ${PAGE} ${PROGRAM}
  COMMAND_ERROR_IS_FATAL ANY)
