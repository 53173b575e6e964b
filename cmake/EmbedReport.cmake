# hemilux_embed_report(OUTPUT FOLDER): writes the source file that holds the page of `solve --report`,
# its style and its scripts, one after the other.
function(hemilux_embed_report output folder)
  set(report_script "")
  foreach(script data text camera scene chart layers steering page)
    list(APPEND scripts ${folder}/${script}.js)
  endforeach()
  foreach(file IN LISTS scripts)
    file(READ ${file} text)
    string(APPEND report_script "${text}")
  endforeach()
  file(READ ${folder}/page.html report_html)
  file(READ ${folder}/page.css report_style)
  configure_file(${folder}/assets.cpp.in ${output} @ONLY)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
               ${scripts} ${folder}/page.html ${folder}/page.css)
endfunction()
