# derive_emit: a library of the equations of motion of a problem, kept current by the build.
#
#   derive_emit(PROBLEM file.toml|name TARGET name
#               [PREFIX prefix] [OPTIONS option ...] [OUTPUT_DIR folder])
#
#   find_package(derive REQUIRED)                        # or include(DeriveEmit)
#   derive_emit(PROBLEM swing.toml TARGET swing)
#   target_link_libraries(app PRIVATE swing)             # app.c: #include "swing.h"
#
# PROBLEM     a file, relative to the current source folder, or one of `derive list`
# TARGET      a static library; with OPTIONS --form header an interface library.  Its include
#             folder is public, and it links libm
# PREFIX      of the files and the functions; TARGET when left out
# OPTIONS     as for `derive emit`: --real float, --jacobian state, …
# OUTPUT_DIR  relative to the current binary folder; derive/TARGET when left out
#
# The code is emitted again when the problem file or a mesh that it names, this call, or a file of
# derive has changed, and not otherwise.  For Ninja and Makefiles, CMake 3.20 or later.
#
# DERIVE_COMMAND (cache): the program, or a list such as "/usr/bin/python3;-m;derive".  Left out,
# `derive` on the PATH or beside Python3_EXECUTABLE, then the module of Python3.

cmake_policy(VERSION 3.20)

# Fill DERIVE_COMMAND and the global properties DERIVE_VERSION, DERIVE_PYTHON, once per
# configuration; `missing` gets what is wrong, or nothing.
function(_derive_find missing)
  set(${missing} "" PARENT_SCOPE)
  get_property(version GLOBAL PROPERTY DERIVE_VERSION)
  if(version)
    return()
  endif()
  if(NOT DERIVE_COMMAND)
    set(hints)
    foreach(python IN ITEMS "${Python3_EXECUTABLE}" "${Python_EXECUTABLE}")
      get_filename_component(folder "${python}" DIRECTORY)
      list(APPEND hints ${folder} ${folder}/Scripts)
    endforeach()
    find_program(DERIVE_COMMAND derive HINTS ${hints} NO_CMAKE_FIND_ROOT_PATH
      DOC "The program derive, or a list such as python3;-m;derive")
  endif()
  if(NOT DERIVE_COMMAND)
    find_package(Python3 QUIET COMPONENTS Interpreter)
    set(command "${Python3_EXECUTABLE}" -m derive)
    _derive_version(version ${command})
    if(version)
      set(DERIVE_COMMAND "${command}" CACHE STRING
        "The program derive, or a list such as python3;-m;derive" FORCE)
    endif()
  endif()
  if(NOT DERIVE_COMMAND)
    set(${missing} "derive was not found on the PATH nor in Python3: activate the virtual \
environment that it is installed in, or configure with -DDERIVE_COMMAND=/path/to/derive"
      PARENT_SCOPE)
    return()
  endif()
  _derive_version(version ${DERIVE_COMMAND})
  list(JOIN DERIVE_COMMAND " " command)
  if(NOT version)
    set(${missing} "`${command} --version` is not derive: configure with \
-DDERIVE_COMMAND=/path/to/derive" PARENT_SCOPE)
    return()
  endif()
  _derive_python(python ${DERIVE_COMMAND})
  set_property(GLOBAL PROPERTY DERIVE_VERSION "${version}")
  set_property(GLOBAL PROPERTY DERIVE_PYTHON "${python}")
  message(STATUS "Found derive: ${command} (version ${version})")
endfunction()

function(_derive_version result)
  set(${result} "" PARENT_SCOPE)
  execute_process(COMMAND ${ARGN} --version
    OUTPUT_VARIABLE text RESULT_VARIABLE status ERROR_QUIET)
  if(status EQUAL 0 AND text MATCHES "^derive ([0-9][^ \r\n]*)")
    set(${result} "${CMAKE_MATCH_1}" PARENT_SCOPE)
  endif()
endfunction()

# The Python that runs derive: that of the list, of the first line of the script, or beside it.
function(_derive_python result program)
  set(${result} "" PARENT_SCOPE)
  file(REAL_PATH "${program}" script)
  get_filename_component(folder "${script}" DIRECTORY)
  set(candidates)
  if("-m" IN_LIST ARGN)
    list(APPEND candidates "${program}")
  endif()
  file(READ "${script}" line LIMIT 512)
  if(line MATCHES "^#! *([^ \r\n]+)")
    list(APPEND candidates "${CMAKE_MATCH_1}")
  endif()
  list(APPEND candidates "${folder}/python3" "${folder}/python" "${folder}/python.exe"
    "${folder}/../python.exe")
  foreach(python IN LISTS candidates)
    execute_process(COMMAND "${python}" -c "import derive.templating"
      RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
    if(status EQUAL 0)
      set(${result} "${python}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
  message(STATUS "the Python of derive was not found: a change of derive itself is seen only "
    "when it changes ${program}")
endfunction()

function(derive_emit)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "PROBLEM;TARGET;PREFIX;OUTPUT_DIR" "OPTIONS")
  foreach(key IN ITEMS PROBLEM TARGET)
    if(NOT arg_${key})
      message(FATAL_ERROR "derive_emit: ${key} is missing; "
        "derive_emit(PROBLEM file.toml TARGET name)")
    endif()
  endforeach()
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "derive_emit: unknown argument ${arg_UNPARSED_ARGUMENTS}; options of "
      "`derive emit` come after OPTIONS")
  endif()
  foreach(option IN LISTS arg_OPTIONS)
    if(option MATCHES "^--(lang|out|prefix|check)(=|$)")
      message(FATAL_ERROR "derive_emit: ${option} cannot be among OPTIONS: the language is C, and "
        "PREFIX and OUTPUT_DIR say the rest")
    endif()
  endforeach()
  if(NOT arg_PREFIX)
    set(arg_PREFIX "${arg_TARGET}")
  endif()
  if(NOT arg_PREFIX MATCHES "^[A-Za-z][A-Za-z0-9_]*$")
    message(FATAL_ERROR "derive_emit: ${arg_PREFIX} cannot start the names of C functions; "
      "add PREFIX name")
  endif()
  if(NOT arg_OUTPUT_DIR)
    set(arg_OUTPUT_DIR "derive/${arg_TARGET}")
  endif()
  get_filename_component(out "${arg_OUTPUT_DIR}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_BINARY_DIR}")
  set(problem "${arg_PROBLEM}")
  set(depends)
  if(problem MATCHES "\\.toml$")
    get_filename_component(problem "${problem}" ABSOLUTE)
    get_source_file_property(generated "${problem}" GENERATED)
    if(NOT generated AND NOT EXISTS "${problem}")
      message(FATAL_ERROR "derive_emit: ${problem}: no such file")
    endif()
    list(APPEND depends "${problem}")
  endif()

  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  if(NOT "C" IN_LIST languages)
    message(FATAL_ERROR "derive_emit: the emitted code is C; add enable_language(C)")
  endif()
  _derive_find(missing)
  if(missing)
    message(FATAL_ERROR "derive_emit: ${missing}")
  endif()
  get_property(version GLOBAL PROPERTY DERIVE_VERSION)
  get_property(python GLOBAL PROPERTY DERIVE_PYTHON)
  list(GET DERIVE_COMMAND 0 program)
  if(IS_ABSOLUTE "${program}" AND NOT "-m" IN_LIST DERIVE_COMMAND)
    list(APPEND depends "${program}")
  endif()

  set(command ${DERIVE_COMMAND} emit "${problem}" --lang c --prefix "${arg_PREFIX}"
    --out "${out}" ${arg_OPTIONS})
  set(call "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/derive_emit_${arg_TARGET}")
  file(CONFIGURE OUTPUT "${call}.txt" CONTENT "derive ${version}: ${command}\n" @ONLY)
  list(APPEND depends "${call}.txt")

  string(REPLACE "=" ";" words "${arg_OPTIONS}")
  set(files "${out}/${arg_PREFIX}.h")
  if(NOT "header" IN_LIST words)
    list(APPEND files "${out}/${arg_PREFIX}.c")
  endif()
  # Ninja reads what the code was made from in a depfile; in the Makefiles of some versions (3.25)
  # a depfile never forgets a file that is gone, so there a target looks at every build.
  set(depfile)
  set(remember)
  set(watch)
  set(script "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/derive_depfile.py")
  if(python AND CMAKE_GENERATOR MATCHES "Ninja")
    set(depfile DEPFILE "${call}.d")
    set(remember COMMAND "${python}" "${script}" "${call}.d" "${out}/${arg_PREFIX}.h" "${problem}")
  elseif(python)
    set(watch derive_emit_${arg_TARGET})
    add_custom_target(${watch}
      COMMAND "${python}" "${script}" --stamp "${call}.stamp" "${problem}"
      DEPENDS ${depends}
      BYPRODUCTS "${call}.stamp"
      COMMENT ""
      VERBATIM)
    list(APPEND depends "${call}.stamp")
  endif()
  add_custom_command(OUTPUT ${files}
    COMMAND ${command}
    ${remember}
    DEPENDS ${depends}
    ${depfile}
    COMMENT "Emitting ${arg_PREFIX} from ${arg_PROBLEM}"
    VERBATIM)

  if("header" IN_LIST words)
    add_library(${arg_TARGET} INTERFACE ${files})
    set(scope INTERFACE)
  else()
    add_library(${arg_TARGET} STATIC ${files})
    set_target_properties(${arg_TARGET} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_compile_features(${arg_TARGET} PRIVATE c_std_99)
    set(scope PUBLIC)
  endif()
  if(watch)
    add_dependencies(${arg_TARGET} ${watch})
  endif()
  set_target_properties(${arg_TARGET} PROPERTIES PUBLIC_HEADER "${out}/${arg_PREFIX}.h")
  target_include_directories(${arg_TARGET} ${scope}
    "$<BUILD_INTERFACE:${out}>" "$<INSTALL_INTERFACE:include>")
  if(NOT MSVC)
    target_link_libraries(${arg_TARGET} ${scope} m)
  endif()
endfunction()
