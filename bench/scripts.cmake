# Puts the Python programs into phlux_bench, so that the installed program needs no file beside it.
foreach(script chart_style figures rays report scenes sampling arithmetic stability precision remedies)
  set(embedded_script ${PROJECT_BINARY_DIR}/embedded_${script}.cpp)
  add_custom_command(
    OUTPUT ${embedded_script}
    COMMAND ${CMAKE_COMMAND} -DSCRIPT=${CMAKE_CURRENT_LIST_DIR}/${script}.py -DFUNCTION=${script}_script
            -DOUTPUT=${embedded_script} -P ${CMAKE_CURRENT_LIST_DIR}/embed_script.cmake
    DEPENDS ${CMAKE_CURRENT_LIST_DIR}/${script}.py ${CMAKE_CURRENT_LIST_DIR}/embed_script.cmake
    COMMENT "Embedding bench/${script}.py"
    VERBATIM)
  target_sources(phlux_bench PRIVATE ${embedded_script})
endforeach()
