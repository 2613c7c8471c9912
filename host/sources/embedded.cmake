# phlux_embed(LIBRARY FOLDER HEADER NAMESPACE FUNCTION EXTENSION...): embeds every file of the folder with one of these
# extensions in the library, whose FUNCTION returns them (embed_files.cmake). The installed program needs no files.
set(embed_files ${CMAKE_CURRENT_LIST_DIR}/embed_files.cmake)
function(phlux_embed library folder header namespace function)
  set(root ${PROJECT_SOURCE_DIR}/${folder})
  list(TRANSFORM ARGN PREPEND ${root}/*. OUTPUT_VARIABLE patterns)
  file(GLOB_RECURSE paths CONFIGURE_DEPENDS ${patterns})
  file(GLOB_RECURSE names RELATIVE ${root} ${patterns})
  list(JOIN names "|" names)
  set(output ${PROJECT_BINARY_DIR}/embedded_${folder}.cpp)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${root} "-DFILES=${names}" -DHEADER=${header} -DNAMESPACE=${namespace}
            -DFUNCTION=${function} -DOUTPUT=${output} -P ${embed_files}
    DEPENDS ${paths} ${embed_files}
    COMMENT "Embedding the files of ${folder}/"
    VERBATIM)
  target_sources(${library} PRIVATE ${output})
endfunction()

phlux_embed(phlux_sources kernels sources/embedded.h phlux::sources embedded_files h cl)
