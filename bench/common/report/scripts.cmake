# Puts the Python programs of bench/ into phlux_bench, so that the installed program needs no file beside it.
file(GLOB_RECURSE scripts CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/bench/*.py)
foreach(path IN LISTS scripts)
  get_filename_component(script ${path} NAME_WE)
  set(embedded_script ${PROJECT_BINARY_DIR}/embedded_${script}.cpp)
  add_custom_command(
    OUTPUT ${embedded_script}
    COMMAND ${CMAKE_COMMAND} -DSCRIPT=${path} -DFUNCTION=${script}_script -DOUTPUT=${embedded_script}
            -P ${CMAKE_CURRENT_LIST_DIR}/embed_script.cmake
    DEPENDS ${path} ${CMAKE_CURRENT_LIST_DIR}/embed_script.cmake
    COMMENT "Embedding ${script}.py"
    VERBATIM)
  target_sources(phlux_bench PRIVATE ${embedded_script})
endforeach()
