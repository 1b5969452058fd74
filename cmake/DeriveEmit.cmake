# derive_emit: a library of the equations of motion of a problem, kept current by the build.
#
#   derive_emit(PROBLEM file.toml|name TARGET name [LANG language ...]
#               [PREFIX prefix] [OPTIONS option ...] [OUTPUT_DIR folder])
#
#   find_package(derive REQUIRED)                        # or include(DeriveEmit)
#   derive_emit(PROBLEM swing.toml TARGET swing)
#   target_link_libraries(app PRIVATE swing)             # app.c: #include "swing.h"
#
# PROBLEM     a file, relative to the current source folder, or one of `derive list`
# TARGET      with C among the files a static library, with headers alone an interface library, both
#             with a public include folder and libm; else a target that emits the files, in `all`
# LANG        c cpp cvode fmu python rust julia javascript, as for `derive emit --lang`; c when left out
# PREFIX      of the files and the functions; TARGET when left out
# OPTIONS     as for `derive emit`: --real float, --jacobian state, --validate, …
# OUTPUT_DIR  relative to the current binary folder; derive/TARGET when left out
#
# The property DERIVE_FILES of the target lists the files, to install or copy them.  SUNDIALS, which
# NAME_cvode.h of LANG cvode includes, is for the program to find and link.
#
# The code is emitted again when the problem file or a mesh that it names, this call, or a file of
# derive has changed, and not otherwise.  For Ninja and Makefiles, CMake 3.20 or later.
#
# Paths may have spaces and $; that of PROBLEM, but for the folder of the build, ; and # as well.
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
    execute_process(COMMAND "${python}" -c "import derive.language.templating"
      RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
    if(status EQUAL 0)
      set(${result} "${python}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
  message(STATUS "the Python of derive was not found: a change of derive itself is seen only "
    "when it changes ${program}")
endfunction()

# Which files a call emits, as derive names them, whole paths in `result`.
function(_derive_files result out)
  execute_process(COMMAND ${ARGN} --names
    OUTPUT_VARIABLE names ERROR_VARIABLE wrong RESULT_VARIABLE status)
  if(status)
    string(STRIP "${wrong}" wrong)
    message(FATAL_ERROR "derive_emit: ${wrong}")
  endif()
  string(REGEX MATCHALL "[^\r\n]+" names "${names}")
  list(TRANSFORM names PREPEND "${out}/")
  set(${result} "${names}" PARENT_SCOPE)
endfunction()

# No two targets may write one file: their builds would do it at once.
function(_derive_claim target)
  foreach(file IN LISTS ARGN)
    get_property(other GLOBAL PROPERTY "DERIVE_TARGET_OF_${file}")
    if(other)
      message(FATAL_ERROR "derive_emit: ${target} would write ${file}, as ${other} does; link to "
        "${other}, or give one of them another PREFIX or OUTPUT_DIR")
    endif()
    set_property(GLOBAL PROPERTY "DERIVE_TARGET_OF_${file}" "${target}")
  endforeach()
endfunction()

# The target of emitted files: a library where there is something to compile or to include.
function(_derive_target target out)
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  set(headers ${ARGN})
  list(FILTER headers INCLUDE REGEX "\\.(h|hpp)$")
  if(NOT headers)
    add_custom_target(${target} ALL DEPENDS ${ARGN})
  elseif(NOT "C" IN_LIST languages)
    message(FATAL_ERROR "derive_emit: the emitted code is C; add enable_language(C)")
  else()
    if("${ARGN}" MATCHES "\\.c(;|$)")
      add_library(${target} STATIC ${ARGN})
      set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
      target_compile_features(${target} PRIVATE c_std_99)
      set(scope PUBLIC)
    else()
      add_library(${target} INTERFACE ${ARGN})
      set(scope INTERFACE)
    endif()
    if("CXX" IN_LIST languages AND "${headers}" MATCHES "\\.hpp(;|$)")
      target_compile_features(${target} ${scope} cxx_std_17)
    endif()
    set_target_properties(${target} PROPERTIES PUBLIC_HEADER "${headers}")
    target_include_directories(${target} ${scope}
      "$<BUILD_INTERFACE:${out}>" "$<INSTALL_INTERFACE:include>")
    if(NOT MSVC)
      target_link_libraries(${target} ${scope} m)
    endif()
  endif()
  set_property(TARGET ${target} PROPERTY DERIVE_FILES "${ARGN}")
endfunction()

function(derive_emit)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "PROBLEM;TARGET;PREFIX;OUTPUT_DIR" "LANG;OPTIONS")
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
    if(option MATCHES "^--(lang|out|prefix|check|names)(=|$)")
      message(FATAL_ERROR "derive_emit: ${option} cannot be among OPTIONS: LANG, PREFIX and "
        "OUTPUT_DIR say what is written and where, and the build that it is current")
    endif()
  endforeach()
  if(NOT arg_LANG)
    set(arg_LANG c)
  endif()
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
  if(out MATCHES "[;#]")
    message(FATAL_ERROR "derive_emit: OUTPUT_DIR ${out}: CMake can build no file whose path has a ; "
      "or a #")
  endif()
  set(problem "${arg_PROBLEM}")
  set(depends)
  if(problem MATCHES "\\.toml$")
    get_filename_component(problem "${problem}" ABSOLUTE)
    get_source_file_property(generated "${problem}" GENERATED)
    if(NOT generated AND NOT EXISTS "${problem}")
      message(FATAL_ERROR "derive_emit: ${problem}: no such file")
    endif()
    if(NOT problem MATCHES "[;#]")  # else the depfile or the stamp below has it alone
      list(APPEND depends "${problem}")
    endif()
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

  set(choices --prefix "${arg_PREFIX}" ${arg_OPTIONS})
  foreach(language IN LISTS arg_LANG)
    list(APPEND choices --lang "${language}")
  endforeach()
  # with a prefix the problem is not read: another target may have yet to make it
  _derive_files(files "${out}" ${DERIVE_COMMAND} emit problem ${choices})
  _derive_claim("${arg_TARGET}" ${files})

  set(call "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/derive_emit_${arg_TARGET}")
  set(said "derive ${version}: ${DERIVE_COMMAND} emit ${problem} --out ${out} ${choices}\n")
  set(before "")
  if(EXISTS "${call}.txt")
    file(READ "${call}.txt" before)
  endif()
  if(NOT before STREQUAL said)
    file(WRITE "${call}.txt" "${said}")
  endif()
  list(APPEND depends "${call}.txt")

  # Ninja reads what the code was made from in a depfile; in the Makefiles of some versions (3.25)
  # a depfile never forgets a file that is gone, and for Ninja they do not escape a $ in the path of
  # one; there a target looks at every build.
  set(depfile)
  set(remember)
  set(watch)
  set(script "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/derive_depfile.py")
  if(python AND CMAKE_GENERATOR MATCHES "Ninja" AND NOT "${CMAKE_BINARY_DIR}" MATCHES "[$]")
    list(GET files 0 first)
    set(depfile DEPFILE "${call}.d")
    string(REPLACE ";" "\\;" item "${problem}")
    set(remember COMMAND "${python}" "${script}" "${call}.d" "${first}" "${item}")
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
    COMMAND ${DERIVE_COMMAND} emit "${problem}" --out "${out}" ${choices}
    ${remember}
    DEPENDS ${depends}
    ${depfile}
    COMMENT "Emitting ${arg_PREFIX} from ${arg_PROBLEM}"
    VERBATIM)

  _derive_target("${arg_TARGET}" "${out}" ${files})
  if(watch)
    add_dependencies(${arg_TARGET} ${watch})
  endif()
endfunction()
