# Writes HEADERS, paths below SOURCE, into FOLDER, where they include each other by sprung/ and their path.
file(REMOVE_RECURSE ${FOLDER})
foreach(header IN LISTS HEADERS)
  file(READ ${SOURCE}/${header} text)
  string(REGEX REPLACE "#include \"(core|render)/([^\"]+)\"" "#include \"sprung/\\1/\\2\"" text "${text}")
  file(WRITE ${FOLDER}/${header} "${text}")
endforeach()
