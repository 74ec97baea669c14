# cmake -DREADME=... -DLANGUAGE=cpp -DOUTPUT=... -P ReadmeExample.cmake: writes the README's first
# block of code in that language to a file; or that of another page. The README's must be shorter than
# 30 lines.
file(READ "${README}" text)
string(FIND "${text}" "\n```${LANGUAGE}\n" begin)
if (begin EQUAL -1)
  message(FATAL_ERROR "${README} has no ${LANGUAGE} example")
endif ()
string(LENGTH "\n```${LANGUAGE}\n" skipped)
math(EXPR begin "${begin} + ${skipped}")
string(SUBSTRING "${text}" "${begin}" -1 text)
string(FIND "${text}" "\n```" end)
string(SUBSTRING "${text}" 0 "${end}" text)
string(REGEX MATCHALL "\n" newlines "${text}")
list(LENGTH newlines lines)
if (README MATCHES "README" AND lines GREATER 28)
  message(FATAL_ERROR "The ${LANGUAGE} example of the README has 30 lines or more")
endif ()
file(WRITE "${OUTPUT}" "${text}\n")
