"""What a quick run leaves out: the long ones that try the tests themselves (mutations, forgeries),
random problems, and most cases of what has many.  ``make rest`` has an eighth of these, every
eighth case, ``make coverage`` half, ``make thorough`` all.  Which cases are run with the others, a
hash of their names and of a seed says: at least one of each language and of each other kind.

A test that is named on the command line, by its file or folder, is run whole, or by ``--quick`` as
in a quick run.
"""

import re
from collections import Counter, defaultdict
from hashlib import sha256
from random import Random

SEED = "1"
"""Of the choice, unless ``--seed`` has another: the same tree is tested alike."""

FORMS = "test_every_form_of_the_state_and_the_jacobians_equal_the_record"
KEPT = {
    "algebra/test_groups.py::test_samples_are_in_the_group": 22,
    "check/test_any_n.py::test_what_is_so_for_some_n_is_refused": 12,
    "check/test_checker_ranges.py::test_no_degree_is_larger_than_that_of_the_bound": 1,
    "check/test_fluid_forgeries.py::test_what_advection_and_energy_rest_on": 1,
    "check/test_forged_kinds.py::test_a_fluid_in_few_directions": 16,
    "check/test_forged_kinds.py::test_a_moment_that_is_negative_by_default": 8,
    "check/test_forged_kinds.py::test_an_equation_of_motion_is_no_identity": 3,
    "check/test_forged_kinds.py::test_the_torus_wrong_at_some_points": 3,
    "check/test_forged_kinds.py::test_what_is_false_by_default_is_said": 2,
    "check/test_forgeries.py::test_no_seed_lets_a_number_of_points_through": 8,
    "check/test_forgeries.py::test_what_is_not_true_of_all_is_refused": 19,
    "check/test_lagrangians.py::test_a_term_that_is_false": 1,
    "check/test_mutations.py::test_a_name_that_nothing_introduces_is_refused": 1,
    "check/test_mutations.py::test_a_wrong_rule_changes_the_equations_and_is_refused": 2,
    "code/test_accuracy.py::test_no_output_is_off_by_more_than_some_units_of_its_terms": 3,
    "code/test_arrays.py::test_jax": 1,
    "code/test_c_agrees.py::test_bits_without_contraction": 1,
    "code/test_c_at_run_time.py::test_no_undefined_behaviour": 0,
    "code/test_c_at_run_time.py::test_nothing_to_remark": 1,
    "code/test_c_builds.py::test_no_file_overrides_the_flags_of_a_project": 2,
    "code/test_charts.py::test_derivatives_of_steps_are_differences_of_steps": 1,
    "code/test_charts.py::test_every_language_says_the_same": 5,
    "code/test_charts.py::test_it_equals_the_record": 3,
    "code/test_conserved.py::test_every_number_is_kept_and_is_that_of_the_search": 4,
    "code/test_conserved.py::test_in_every_form_of_the_state": 3,
    "code/test_conserved.py::test_one_order_in_all_languages_that_of_the_symmetries": 1,
    "code/test_conserved.py::test_proved_by_the_validator": 2,
    "code/test_device_steps.py::test_a_motion_of_each_thread": 2,
    "code/test_discrete_step.py::test_it_has_its_order": 3,
    "code/test_discrete_step.py::test_it_is_the_motion_that_the_record_tells": 1,
    "code/test_discrete_step.py::test_momenta_are_kept_to_rounding": 1,
    "code/test_discrete_step.py::test_the_energy_does_not_drift": 1,
    "code/test_discrete_step.py::test_the_group_is_kept": 1,
    "code/test_discrete_step.py::test_too_large_a_step_is_told_on_any_group": 1,
    "code/test_drift.py::test_a_velocity_that_leaves_the_group_is_made_tangent": 7,
    "code/test_drift.py::test_c_does_as_python_and_in_place": 2,
    "code/test_drift.py::test_in_the_principal_frame_the_group_is_the_same": 5,
    "code/test_drift.py::test_one_step_squares_the_error": 9,
    "code/test_drift.py::test_the_relations_of_a_family_single_it_out": 4,
    "code/test_ensemble.py::test_all_are_those_of_one_by_one": 2,
    "code/test_ensemble.py::test_each_is_that_of_one_by_one": 2,
    "code/test_equal_moments.py::test_one_choice": 8,
    "code/test_forms.py::test_a_form_moves_as_another": 16,
    "code/test_forms.py::test_the_jacobian_is_the_derivative": 4,
    "code/test_frame.py::test_numbers_that_are_not_finite_are_refused": 2,
    "code/test_frame.py::test_the_problem_in_the_frame_is_checked_like_any_other": 1,
    "code/test_gauss_jax.py::test_over_devices": 0,
    "code/test_gauss_jax.py::test_the_derivative_of_a_motion": 0,
    "code/test_gauss_jax.py::test_the_steps_are_those_of_python": 1,
    "code/test_group_functions.py::test_exp_and_log_have_all_digits": 27,
    "code/test_group_functions.py::test_jacobians_are_those_of_differences": 27,
    "code/test_group_functions.py::test_local_is_the_inverse_of_retract": 27,
    "code/test_indefinite.py::test_pushes_move_as_the_inverse_says": 4,
    "code/test_known_motions.py::test_emitted_code_moves_as_is_known": 12,
    "code/test_languages.py::test_every_compiler_says_the_same": 6,
    "code/test_matrix_state.py::test_a_lagrangian_of_ones_own_equals_the_record": 1,
    "code/test_momenta.py::test_c_and_python_beside_the_derivatives_of_the_lagrangian": 1,
    "code/test_momenta_of_points.py::test_beside_sums_over_the_points": 6,
    "code/test_momenta.py::test_validated": 2,
    "code/test_name_collisions.py::test_in_a_language": 1,
    "code/test_names_true.py::test_no_name_lies": 4,
    "code/test_pairs_of_options.py::test_every_language_says_the_same": 5,
    "code/test_pairs_of_options.py::test_they_equal_the_record": 4,
    "code/test_step_jacobian.py::test_the_derivative_is_that_of_the_step": 10,
    "code/test_steps.py::test_a_tolerance_is_kept": 5,
    "code/test_steps.py::test_every_form_moves_alike_and_goes_back": 6,
    "code/test_steps.py::test_every_form_of_the_state_has_the_same_events": 1,
    "code/test_steps.py::test_so_it_is_over_coarse_steps": 2,
    "code/test_steps.py::test_the_compiler_changes_nothing": 2,
    "code/test_steps.py::test_the_end_of_a_motion_is_told": 8,
    "code/test_steps.py::test_the_error_falls_with_the_order": 9,
    "code/test_steps.py::test_what_gauss_keeps_is_found": 3,
    "code/test_steps.py::test_what_is_kept_over_many_steps": 5,
    "code/test_torus.py::test_c_python_and_plain_sums_agree": 3,
    "code/test_torus.py::test_energy_and_traces_are_kept": 2,
    "code/test_torus.py::test_the_vorticity_is_measured_as_one": 4,
    "command/test_cli.py::test_a_text_is_as_wide_as_what_shows_it": 4,
    "command/test_emission_errors.py::test_a_problem_of_any_name_runs": 1,
    "command/test_emission_errors.py::test_prefixes_of_libc_are_harmless": 1,
    "command/test_emitted_files.py::test_a_check_needs_no_options": 4,
    "command/test_encoding.py::test_formats_that_are_files_stay_utf8": 1,
    "command/test_encoding.py::test_letters_that_are_lost_are_said_once": 2,
    "command/test_interruptions.py::test_an_interruption_is_quiet": 1,
    "command/test_interruptions.py::test_builds_killed_at_any_moment": 0,
    "command/test_interruptions.py::test_nobody_reads": 1,
    "command/test_progress.py::test_it_counts_on_a_terminal": 1,
    "command/test_refused_options.py::test_the_reasons_are_those_of_the_command": 3,
    "command/test_refused_options.py::test_what_is_not_refused_is_made": 8,
    "command/test_searches.py::test_it_is_shown_in_every_format": 9,
    "command/test_strangers.py::test_in_a_process_of_its_own": 1,
    "command/test_strangers.py::test_some_cases_of_the_fuzzer": 0,
    "command/test_strangers.py::test_the_corpus": 0,
    "command/test_without_arrays.py::test_checks_are_the_same": 0,
    "command/test_without_arrays.py::test_code_is_the_same": 2,
    "command/test_without_arrays.py::test_forged_records_of_the_torus_are_refused_alike": 0,
    "command/test_without_arrays.py::test_symmetries_are_the_same": 1,
    "command/test_without_arrays.py::test_walks_are_the_same": 1,
    "equilibria/test_stability.py::test_every_step_is_checked": 1,
    "integrals/test_conditions.py::test_a_grid_has_no_others": 1,
    "integrals/test_motions.py::test_along_a_motion": 2,
    "integrals/test_told.py::test_a_false_casimir_and_a_false_level_are_refused": 0,
    "integrals/test_told.py::test_a_false_integral_is_refused": 1,
    "language/test_read.py::test_all_that_is_printed_is_read": 27,
    "motion/test_ensembles.py::test_a_file_holds_the_ensemble": 1,
    "motion/test_ensembles.py::test_a_full_disk_is_told_and_the_old_file_stays": 1,
    "motion/test_ensembles.py::test_no_more_than_a_part_is_in_memory": 0,
    "motion/test_events.py::test_a_rotation_has_its_quarters": 3,
    "motion/test_events.py::test_events_on_the_torus": 2,
    "motion/test_events.py::test_steps_of_one_size_are_the_same_with_events": 2,
    "motion/test_initial.py::test_the_ready_made_starts_move": 3,
    "motion/test_interrupted.py::test_ctrl_c_within_a_part_keeps_what_is_done_of_it": 3,
    "motion/test_interrupted.py::test_in_c_it_is_where_the_call_has_led": 4,
    "motion/test_interrupted.py::test_in_python_it_is_where_the_last_call_has_led": 4,
    "motion/test_methods.py::test_a_collision_is_told_by_both": 1,
    "motion/test_methods.py::test_c_and_python_agree": 1,
    "motion/test_methods.py::test_events_are_those_of_both": 1,
    "motion/test_methods.py::test_explicit_steps_ask_equally_often": 1,
    "motion/test_methods.py::test_steps_of_one_size_cost_no_more_of_them": 1,
    "motion/test_motion.py::test_far_starts_are_taken_to_the_nearest_rotation": 2,
    "page/test_in_a_browser.py::test_a_plane_is_seen_as_it_is": 2,
    "page/test_motion_page.py::test_every_page_is_small": 1,
    "playground/test_form.py::test_a_ready_made_problem_is_shown_and_kept": 6,
    "playground/test_form.py::test_texts_are_never_markup": 2,
    "playground/test_moving.py::test_screen_readers_and_contrast": 1,
    "playground/test_play.py::test_a_motion_has_what_the_page_of_the_command_has": 2,
    "playground/test_play.py::test_files_are_those_of_the_command": 3,
    "playground/test_play.py::test_files_of_strangers_end_in_a_line": 3,
    "playground/test_play.py::test_the_browser_is_told_the_same": 6,
    "playground/test_scripts.py::test_names_of_the_velocity_are_the_emitted_ones": 2,
    "plot/test_committed_pictures.py::test_a_picture_is_drawn_from_its_run": 3,
    "plot/test_committed_pictures.py::test_a_run_is_that_of_its_command": 2,
    "plot/test_ensemble_pictures.py::test_the_command_and_python": 1,
    "plot/test_ensemble_pictures.py::test_the_same_bytes_twice": 1,
    "plot/test_pictures.py::test_labels_of_axes_are_off_the_outline_and_titles_on_the_sheet": 2,
    "plot/test_pictures.py::test_no_text_leaves_its_sheet": 8,
    "plot/test_pictures_in_notes.py::test_the_picture_of_each_problem_is_beside_and_shown": 1,
    "plot/test_pictures.py::test_every_kind_has_the_same_bytes_twice": 1,
    "problem/test_bad_problems.py::test_it_is_taken": 4,
    "problem/test_bad_problems.py::test_what_may_be_negative_is_taken_with_a_warning": 4,
    "problem/test_followed_names.py::test_they_are_those_of_the_emitted_code": 12,
    "problem/test_hints.py::test_every_command_may_be_stopped": 4,
    "problem/test_kinds.py::test_a_record_of_another_form_is_refused": 8,
    "problem/test_kinds.py::test_an_example_holds": 1,
    "problem/test_kinds.py::test_in_the_principal_frame_or_refused": 3,
    "problem/test_powers.py::test_another_exponent_is_refused": 5,
    "problem/test_powers.py::test_every_power_holds_in_a_record": 1,
    "problem/test_powers.py::test_higher_powers_of_a_derivative_hold": 1,
    "problem/test_springs.py::test_in_other_languages": 5,
    "problem/test_springs.py::test_length_0_is_that_of_a_linear_spring": 1,
    "project/test_consumers.py::test_cmake": 1,
    "project/test_consumers.py::test_cmake_all_languages_and_strange_paths": 0,
    "project/test_consumers.py::test_cmake_calls_that_are_wrong": 3,
    "project/test_consumers.py::test_cmake_options_and_ready_made_problems": 0,
    "project/test_docs.py::test_a_page_runs": 1,
    "project/test_needs.py::test_what_is_left_out_is_said_in_one_line": 0,
    "python/test_as_sympy.py::test_how_many_need_no_function": 0,
    "python/test_as_sympy.py::test_values": 1,
    "python/test_compiled.py::test_a_motion_begins_on_the_group_by_the_same_rule_on_each": 3,
    "python/test_expressions.py::test_the_same_numbers": 2,
    "python/test_notebook.py::test_the_checks_hold_and_the_top_keeps_its_energy": 0,
    "python/test_notebook.py::test_walk_step_and_equation_are_formulas": 0,
    "record/test_every_record.py::test_another_seed_holds_too": 2,
    "record/test_every_record.py::test_it_holds_and_is_read_back": 12,
    "record/test_every_record.py::test_its_data_are_of_one_form": 60,
    "record/test_every_record.py::test_the_order_of_what_is_given_says_nothing": 2,
    "record/test_record.py::test_moments_that_are_not_those_of_the_solids_are_found": 1,
    "record/test_record.py::test_solids_and_points_together": 0,
    "record/test_record.py::test_the_tensor_of_solids_and_points_together": 0,
    "record/test_changed_records.py::test_none_is_held": 24,
    "record/test_uses.py::test_a_rule_misses_what_is_withdrawn": 0,
    "record/test_uses.py::test_an_emptied_list_is_refused_by_the_command": 1,
    "reduction/test_reduction_checked.py::test_other_fields_are_refused": 0,
    "reduction/test_reduction_command.py::test_where_a_configuration_is_left_as_it_is": 2,
    "symmetries/test_circulation.py::test_it_is_the_circulation_about_each_axis_of_the_body": 3,
    "symmetries/test_counts.py::test_counts": 5,
    "symmetries/test_counts.py::test_counts_of_ready_made_problems": 5,
    "validate/test_attitude.py::test_every_change_is_refused": 0,
    "validate/test_discrete_functions.py::test_a_change_of_a_function_of_a_step_is_refused": 1,
    "validate/test_discrete_functions.py::test_the_functions_of_a_step_are_read_back": 3,
    "validate/test_torus_files.py::test_no_change_of_c_passes": 0,
    "validate/test_torus_files.py::test_what_is_emitted_equals_the_record": 7,
    "validate/test_validation.py::test_a_change_of_a_jacobian_is_refused": 0,
    "validate/test_validation.py::test_every_change_of_the_code_is_refused": 1,
    "validate/test_validation.py::test_every_ready_made_problem_equals_its_record": 3,
    "validate/test_validation.py::test_python_that_is_run_and_not_read_must_be_what_is_emitted": 5,
    "validate/test_validation.py::test_code_with_steps_in_time_equals_the_record": 4,
    "views/test_html.py::test_in_a_browser": 1,
    "views/test_language.py::test_no_english_is_left": 12,
    "views/test_language.py::test_records_read_back_say_the_same": 0,
    "views/test_language_faults.py::test_a_fault_in_one_language_is_seen": 7,
    "views/test_notes.py::test_notes_of_three_groups": 1,
    "views/test_read_back.py::test_a_printer_that_is_wrong_is_seen": 5,
    "views/test_read_back.py::test_every_page_says_what_its_record_says": 2,
    "views/test_read_back.py::test_names_that_look_like_others_are_printed_apart": 1,
    "views/test_read_back.py::test_random_trees_are_read_in_one_way": 2,
    "views/test_sentences_read_back.py::test_every_sentence_of_a_walk_is_read_back": 30,
    "views/test_sentences_read_back.py::test_every_sentence_of_what_is_found_is_read_back": 36,
    "views/test_views.py::test_an_equation_is_found_by_its_key_and_the_first_by_its_step": 1,
    "views/test_views.py::test_latex_compiles_within_its_margins": 2,
    "walk/lie/test_expressed.py::test_ready_made": 1,
    "walk/lie/test_points_typed.py::test_the_numbers_are_the_same": 2,
    "walk/lie/test_random_lagrangians.py::test_holds_and_agrees": 0,
    "walk/lie/test_reduced.py::test_the_code_agrees": 1,
    "walk/test_any_problem.py::test_code_agrees_with_the_oracle": 12,
    "walk/test_any_problem.py::test_solids_are_their_moments": 1,
    "walk/test_dirichlet.py::test_steady_ellipsoids": 4,
    "walk/test_dirichlet.py::test_circulation_is_kept_where_the_record_says_so": 5,
    "walk/test_discrete_map.py::test_the_map_is_of_order_2": 1,
    "walk/test_engine_mutations.py::test_a_sample_of_all_rules": 0,
    "walk/test_engine_mutations.py::test_a_wrong_rule_is_caught": 1,
    "walk/test_engine_mutations.py::test_another_basis_of_the_same_algebra_is_no_fault": 0,
    "walk/test_engine_mutations.py::test_the_oracle_agrees_with_what_is_not_changed": 6,
    "walk/test_explicit.py::test_a_motion_by_a_one_parameter_group": 1,
    "walk/test_explicit.py::test_what_is_too_long_is_not_multiplied_out": 1,
    "walk/test_fluid.py::test_where_the_density_is_the_same_the_pressure_alone_sees_a_force": 0,
    "walk/test_kept_momenta.py::test_all_that_leave_the_potential_alone": 1,
    "walk/test_kept_momenta.py::test_harmonic_forces": 2,
    "walk/test_names_of_the_problem.py::test_the_numbers_of_inputs_have_the_names_of_the_file": 2,
    "walk/test_random_problems.py::test_points": 0,
    "walk/test_random_problems.py::test_solids": 0,
    "walk/test_random_problems.py::test_solids_and_points": 0,
    "walk/test_potentials.py::test_it_moves_as_gauss_says": 6,
    "walk/test_self_gravity.py::test_emitted_code_is_read_back_and_no_change_of_it_passes": 2,
    "walk/test_self_gravity.py::test_maclaurins_spheroids": 1,
    "walk/test_self_gravity.py::test_motion_is_that_of_points_under_gauss_principle": 2,
    "walk/test_self_gravity.py::test_the_circulation_is_found": 0,
    "walk/test_self_gravity.py::test_the_energy_is_that_of_newtons_law": 2,
    "walk/test_signed_masses.py::test_constants_tell_good_bodies": 4,
    "walk/test_signed_masses.py::test_masses_that_are_expressions_are_seen_to_be_negative": 1,
    "walk/test_signed_masses.py::test_moments_of_positive_masses_are_none_of_any_masses": 0,
    "walk/test_signed_masses.py::test_no_hypothesis_that_does_not_hold": 1,
    "walk/test_signed_masses.py::test_numbers_tell_it_where_the_record_does_not": 0,
    "walk/test_signed_masses.py::test_the_counterexample_is_refused": 2,
    "walk/test_signed_masses.py::test_the_equations_and_all_other_words_are_the_same": 4,
    "walk/test_signed_masses.py::test_the_key_has_one_value": 0,
    "walk/test_sizes.py::test_code_against_points": 8,
    "walk/test_stages.py::test_what_runs_is_what_the_table_says": 8,
    "walk/test_superposition.py::test_the_second_of_two_adds_what_the_first_adds": 5,
    "walk/test_variation.py::test_where_the_ends_move_their_momentum_remains": 1,
    f"validate/test_validation.py::{FORMS}": 2,
}
"""Test → how many of its cases are run with the others, and more where it has more kinds of them:
two seconds or so."""

WORDS = (
    "c cpp python javascript rust julia jax gauss vern rk discrete left right plain quaternion "
    "tangent columns col header float attraction expression far_centre field gravity "
    "harmonic self_gravity spring torsion volume damping"
)
KINDS = frozenset(WORDS.split(" "))
"""What no test leaves out that has cases of it: languages, steps, forms of the state, energies."""
SPELT = {"g++": "cpp", "clang++": "cpp"}


def kinds(item):
    """The kinds that the name of a case has: ``so3-rust2021`` is one of Rust; what stands before a
    colon is its own kind, as in ``discrete: so3``."""
    case = item.nodeid.partition("[")[2].lower()
    words = re.split(r"[^\w+/.]+", case)
    plain = (x.rstrip("0123456789") for x in words)
    named = re.match(r"(\w+(?: of \w+)?): ", case)
    return (KINDS & {SPELT.get(x, x) for x in plain}) | ({named[1]} if named else set())


def chosen(cases, count, seed):
    """So many cases of a test by a hash, the first of each kind before the others; no kind is
    missing unless all are."""
    drawn = sorted(cases, key=lambda x: sha256(f"{seed} {x.nodeid}".encode()).digest())
    seen, first, rest = set(), [], []
    for case in drawn:
        (rest if kinds(case) <= seen else first).append(case)
        seen |= kinds(case)
    return [*first, *rest][: count and max(count, len(first))]


def share(items, n):
    """Every n-th one of some items, of each test the first, and the rest; for 0 none."""
    seen, run, rest = Counter(), [], []
    for item in items:
        name = item.nodeid.partition("[")[0]
        (rest if n == 0 or seen[name] % n else run).append(item)
        seen[name] += 1
    return run, rest


def split(items, seed=SEED):
    """The items of pytest that are run, and those that are left."""
    cases = defaultdict(list)
    for item in items:
        cases[item.nodeid.removeprefix("tests/").partition("[")[0]].append(item)
    run = {x for name, own in cases.items() for x in chosen(own, KEPT.get(name, len(own)), seed)}
    return [x for x in items if x in run], [x for x in items if x not in run]


def shuffled(items, seed):
    """The items in an order by chance, those of one file one after the other."""
    order = Random(seed)
    files = defaultdict(list)
    for item in order.sample(items, len(items)):
        files[item.path].append(item)
    return [x for path in order.sample(sorted(files), len(files)) for x in files[path]]
