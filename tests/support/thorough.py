"""What a run of all tests leaves to ``make coverage``, which has them all: the long ones that try
the tests themselves (mutations, forgeries), random problems, and most cases of what has many.

A test that is named on the command line, by its file or folder, is run whole.
"""

from collections import Counter

FORMS = "test_every_form_of_the_state_and_the_jacobians_equal_the_record"
KEPT = {
    "check/test_checker_ranges.py::test_no_degree_is_larger_than_that_of_the_bound": 2,
    "check/test_lagrangians.py::test_a_term_that_is_false": 3,
    "check/test_mutations.py::test_a_name_that_nothing_introduces_is_refused": 1,
    "check/test_mutations.py::test_a_wrong_rule_changes_the_equations_and_is_refused": 5,
    "check/test_mutations.py::test_every_corruption_of_a_step_is_refused": 25,
    "check/test_suppositions.py::test_no_hypothesis_can_be_left_out": 3,
    "check/test_suppositions.py::test_nothing_that_is_given_can_be_left_out": 3,
    "code/test_accuracy.py::test_no_output_is_off_by_more_than_some_units_of_its_terms": 6,
    "code/test_arrays.py::test_jax": 1,
    "code/test_c_agrees.py::test_bits_without_contraction": 1,
    "code/test_c_at_run_time.py::test_no_undefined_behaviour": 0,
    "code/test_c_at_run_time.py::test_nothing_to_remark": 1,
    "code/test_conserved.py::test_every_number_is_kept_and_is_that_of_the_search": 6,
    "code/test_conserved.py::test_proved_by_the_validator": 6,
    "code/test_drift.py::test_c_does_as_python_and_in_place": 6,
    "code/test_drift.py::test_one_step_squares_the_error": 30,
    "code/test_equal_moments.py::test_one_choice": 20,
    "code/test_frame.py::test_numbers_that_are_not_finite_are_refused": 2,
    "code/test_frame.py::test_the_c_moves_alike": 4,
    "code/test_frame.py::test_the_motion_is_the_same": 12,
    "code/test_frame.py::test_the_problem_in_the_frame_is_checked_like_any_other": 2,
    "code/test_languages.py::test_every_language_says_the_same": 4,
    "code/test_languages.py::test_floats_agree_to_their_accuracy": 2,
    "code/test_name_collisions.py::test_in_a_language": 3,
    "code/test_name_collisions.py::test_in_c_and_in_python": 2,
    "code/test_names_true.py::test_no_name_lies": 6,
    "code/test_options.py::test_c_in_every_form": 2,
    "code/test_options.py::test_the_jacobian_is_the_derivative": 6,
    "command/test_faults.py::test_builds_killed_at_any_moment": 0,
    "command/test_strangers.py::test_in_a_process_of_its_own": 1,
    "command/test_strangers.py::test_some_cases_of_the_fuzzer": 0,
    "command/test_strangers.py::test_the_corpus": 0,
    "problem/test_hints.py::test_a_negative_stiffness": 3,
    "problem/test_kinds.py::test_an_example_holds": 4,
    "problem/test_powers.py::test_higher_powers_of_a_derivative_hold": 1,
    "project/test_consumers.py::test_cmake": 1,
    "project/test_consumers.py::test_cmake_all_languages_and_strange_paths": 0,
    "project/test_consumers.py::test_cmake_options_and_ready_made_problems": 0,
    "project/test_docs.py::test_a_page_runs": 3,
    "project/test_needs.py::test_what_is_left_out_is_said_in_one_line": 0,
    "python/test_notebook.py::test_walk_step_and_equation_are_formulas": 0,
    "python/test_as_sympy.py::test_how_many_need_no_function": 0,
    "python/test_as_sympy.py::test_values": 3,
    "python/test_expressions.py::test_the_same_numbers": 2,
    "record/test_fields.py::test_no_field_can_be_changed_unseen": 0,
    "record/test_fields.py::test_no_field_can_be_left_out_unseen": 0,
    "record/test_record.py::test_another_seed_holds_too": 1,
    "record/test_record.py::test_moments_that_are_not_those_of_the_solids_are_found": 1,
    "record/test_record.py::test_solids_and_points_together": 0,
    "record/test_record.py::test_the_tensor_of_solids_and_points_together": 0,
    "record/test_symbols.py::test_a_symbol_too_few_too_many_or_twice_is_refused": 1,
    "record/test_symbols.py::test_another_name_is_refused": 0,
    "record/test_symbols.py::test_every_change_of_a_symbol_is_refused": 1,
    "record/test_symbols.py::test_the_symbols_of_every_record_hold": 5,
    "record/test_uses.py::test_a_rule_misses_what_is_withdrawn": 0,
    "record/test_uses.py::test_an_emptied_list_is_refused_by_the_command": 1,
    f"validate/test_validation.py::{FORMS}": 2,
    "validate/test_validation.py::test_a_change_of_a_jacobian_is_refused": 0,
    "validate/test_validation.py::test_every_change_of_the_code_is_refused": 2,
    "validate/test_validation.py::test_every_ready_made_problem_equals_its_record": 5,
    "views/test_html.py::test_in_a_browser": 1,
    "views/test_language.py::test_french_latex_compiles_within_its_margins": 1,
    "views/test_language_faults.py::test_a_fault_in_one_language_is_seen": 8,
    "views/test_notes.py::test_notes_of_three_groups": 1,
    "views/test_read_back.py::test_a_printer_that_is_wrong_is_seen": 10,
    "views/test_read_back.py::test_every_page_says_what_its_record_says": 5,
    "views/test_read_back.py::test_names_that_look_like_others_are_printed_apart": 3,
    "views/test_read_back.py::test_random_trees_are_read_in_one_way": 2,
    "views/test_views.py::test_latex_compiles_within_its_margins": 2,
    "walk/lie/test_points_typed.py::test_the_numbers_are_the_same": 3,
    "walk/lie/test_random_lagrangians.py::test_holds_and_agrees": 0,
    "walk/test_any_problem.py::test_code_agrees_with_the_oracle": 12,
    "walk/test_any_problem.py::test_solids_are_their_moments": 1,
    "walk/test_any_problem.py::test_the_record_holds": 10,
    "walk/test_engine_mutations.py::test_a_sample_of_all_rules": 0,
    "walk/test_engine_mutations.py::test_a_wrong_rule_is_caught": 2,
    "walk/test_engine_mutations.py::test_another_basis_of_the_same_algebra_is_no_fault": 0,
    "walk/test_engine_mutations.py::test_the_oracle_agrees_with_what_is_not_changed": 0,
    "walk/test_far_centre.py::test_of_any_moments": 2,
    "walk/test_field.py::test_on_groups": 3,
    "walk/test_random_problems.py::test_points": 0,
    "walk/test_random_problems.py::test_solids": 0,
    "walk/test_random_problems.py::test_solids_and_points": 0,
    "walk/test_signed_masses.py::test_constants_tell_good_bodies": 4,
    "walk/test_signed_masses.py::test_masses_that_are_expressions_are_seen_to_be_negative": 1,
    "walk/test_signed_masses.py::test_moments_of_positive_masses_are_none_of_any_masses": 0,
    "walk/test_signed_masses.py::test_no_hypothesis_that_does_not_hold": 2,
    "walk/test_signed_masses.py::test_numbers_tell_it_where_the_record_does_not": 0,
    "walk/test_signed_masses.py::test_the_counterexample_is_refused": 2,
    "walk/test_signed_masses.py::test_the_key_has_one_value": 0,
    "walk/test_sizes.py::test_code_against_points": 8,
    "walk/test_sizes.py::test_the_record_holds": 1,
}
"""Test → how many of its cases, the first ones, are run with the others."""


def split(items):
    """The items of pytest that are run, and those that are left."""
    seen, run, left = Counter(), [], []
    for item in items:
        name = item.nodeid.removeprefix("tests/").partition("[")[0]
        seen[name] += 1
        (run if seen[name] <= KEPT.get(name, seen[name]) else left).append(item)
    return run, left
