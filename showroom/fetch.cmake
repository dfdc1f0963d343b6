# cmake -DNPM=... -DSOURCE=... -DWORK=... -DOUT=... -P fetch.cmake: the files of package-lock.json that the site needs, with
# their licences, and no more; the lock file holds their hashes.
file(MAKE_DIRECTORY ${WORK})
file(COPY ${SOURCE}/package.json ${SOURCE}/package-lock.json DESTINATION ${WORK})
execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund WORKING_DIRECTORY ${WORK}
  RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(failed)
  message(FATAL_ERROR "npm could not fetch the show room's viewer (no network?):\n${said}\n"
    "Try again, or configure with -DVITRINE_SHOWROOM=OFF, which leaves out the pages of `vitrine showroom`.")
endif()
set(modules ${WORK}/node_modules)
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
file(COPY_FILE ${modules}/@google/model-viewer/dist/model-viewer.min.js ${OUT}/model-viewer.min.js)
# The viewer loads its decoder as a classic script that leaves MeshoptDecoder behind.
file(COPY_FILE ${modules}/meshoptimizer/meshopt_decoder.cjs ${OUT}/meshopt_decoder.js)
# model-viewer.min.js holds three.js, lit and what else its package depends on.
set(text "Licences of the scripts in this folder.\n\nmodel-viewer.min.js holds @google/model-viewer and parts of the "
  "packages that it depends on; meshopt_decoder.js is meshoptimizer's.\n")
string(REPLACE ";" "" text "${text}")
file(GLOB licences ${modules}/*/LICENSE* ${modules}/*/license* ${modules}/@*/*/LICENSE* ${modules}/@*/*/license*)
list(SORT licences)
list(REMOVE_DUPLICATES licences)
foreach(licence IN LISTS licences)
  file(RELATIVE_PATH name ${modules} ${licence})
  file(READ ${licence} words)
  string(APPEND text "\n---- ${name} ----\n\n${words}\n")
endforeach()
file(WRITE ${OUT}/LICENSES.txt "${text}")
