//! Checking a test: all cases by all runners, and the minimisation of the first failure.

use super::file::TestKernel;
use super::outcome::Outcome;
use super::report::{self, Failing};
use super::run::{Runner, RunnerError, interpret_cases};
use super::verdict::{Failure, Passed, Verdict};
use std::cell::Cell;
use std::rc::Rc;
use std::time::{Duration, Instant};
use straightline_evaluator::diagnostic::{Code, Diagnostic, Errors};
use straightline_evaluator::front::testing::Test;
use straightline_kernels::properties::{Argument, CASES, Case, SEED, generate_cases, minimise_case};

/// Cases of a check, and its limit.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// Number of cases of a property.
    pub cases: usize,
    /// Seed of random values.
    pub seed: u64,
    /// Time for all runs of the interpreter.
    pub time: Duration,
}

impl Default for Plan {
    fn default() -> Self {
        Plan {
            cases: CASES,
            seed: SEED,
            time: Duration::from_secs(20),
        }
    }
}

impl Plan {
    /// The cases of a test: one without arguments, if it has no property.
    pub fn cases_of(&self, test: &Test) -> Vec<Case> {
        let arguments: Vec<Argument> = test.arguments.iter().map(|(_, argument)| *argument).collect();
        match arguments.is_empty() {
            true => vec![Case::new()],
            false => generate_cases(&arguments, self.cases, self.seed),
        }
    }
}

/// Runs a test without a picture by the interpreter in `f32`, then by `device`, and in `f64` by the interpreter.
pub fn check_test(kernel: &TestKernel, plan: &Plan, device: Option<&mut dyn Runner>) -> Verdict {
    let arguments: Vec<Argument> = kernel.test.arguments.iter().map(|(_, argument)| *argument).collect();
    let cases = plan.cases_of(&kernel.test);
    let deadline = Rc::new(Cell::new(Instant::now() + plan.time));
    let mut single = Interpreted {
        double: false,
        deadline: Rc::clone(&deadline),
    };
    let mut double = Interpreted {
        double: true,
        deadline: Rc::clone(&deadline),
    };
    let mut runners: Vec<&mut dyn Runner> = vec![&mut single];
    runners.extend(device);
    runners.push(&mut double);
    let mut outcomes: Vec<Vec<Outcome>> = Vec::new();
    for runner in &mut runners {
        match runner.run_cases(kernel, &cases) {
            Ok(found) => outcomes.push(found),
            Err(error) => return Verdict::Failed(Box::new(report_not_run(kernel, &error))),
        }
    }
    let held = outcomes[0].iter().filter(|outcome| **outcome == Outcome::Held).count();
    let last = outcomes.len() - 1;
    // A failure in `f64` alone is no failure of the shader.
    let failing = (0..=last).find_map(|runner| {
        let case = outcomes[runner]
            .iter()
            .position(|outcome| outcome.violation().is_some())?;
        Some((runner, case))
    });
    let Some((by, case)) = failing else {
        return match held {
            0 => Verdict::Failed(Box::new(passed_over(kernel, cases.len()))),
            cases => Verdict::Passed(Passed { cases, note: None }),
        };
    };
    let found = minimise(kernel, &arguments, &cases[case], &outcomes[by][case], &mut *runners[by]);
    // The report needs one case more, however long the minimisation took.
    deadline.set(Instant::now() + plan.time);
    let mut results = Vec::new();
    for runner in &mut runners {
        let outcome = runner.run_cases(kernel, std::slice::from_ref(&found)).ok();
        results.push((runner.name(), outcome.and_then(|mut all| all.pop())));
    }
    let failing = Failing {
        kernel,
        case: &found,
        by,
        results,
    };
    match by == last {
        true => Verdict::Passed(Passed {
            cases: held,
            note: Some(report::report_double(&failing)),
        }),
        false => Verdict::Failed(Box::new(report::report_failure(&failing))),
    }
}

/// The simplest case found in which the same assertion fails.
fn minimise(
    kernel: &TestKernel,
    arguments: &[Argument],
    case: &Case,
    outcome: &Outcome,
    runner: &mut dyn Runner,
) -> Case {
    let Some(site) = outcome.violation().map(|violation| violation.site) else {
        return case.clone();
    };
    minimise_case(arguments, case, &mut |cases| match runner.run_cases(kernel, cases) {
        Ok(outcomes) => {
            let fails = |outcome: &Outcome| outcome.violation().is_some_and(|violation| violation.site == site);
            outcomes.iter().map(fails).collect()
        }
        Err(_) => vec![false; cases.len()],
    })
}

/// Reports a test that could not be run.
pub fn report_not_run(kernel: &TestKernel, error: &RunnerError) -> Failure {
    let what = format!("`{}` could not be run: {error}", kernel.test.path);
    match error {
        RunnerError::Limit(_) => {
            let help = match kernel.test.picture {
                Some(_) => "let its loops end sooner, or draw a smaller picture",
                None => "let its loops end sooner, or give it fewer cases: `--cases 16`",
            };
            unplaced(kernel, Code::Limit, what, "this test", help)
        }
        RunnerError::Failed(_) => {
            let help = "run it by the interpreter alone: `--without-gpu`";
            unplaced(kernel, Code::StageUnfit, what, "this test", help)
        }
    }
}

fn passed_over(kernel: &TestKernel, cases: usize) -> Failure {
    let what = format!(
        "`{}` checks nothing: `assume` passes over all {cases} cases",
        kernel.test.path
    );
    let help = "write the range: `for_all_in(0.0..1.0, |x: f32| ..)`";
    unplaced(kernel, Code::Assertion, what, "no case is left", help)
}

fn unplaced(kernel: &TestKernel, code: Code, what: String, label: &str, help: &str) -> Failure {
    let error = Diagnostic::error_at(code, kernel.test.span, what)
        .label(label)
        .help(help);
    Failure::from_errors(Errors::new(vec![error], &kernel.files))
}

/// The interpreter.
struct Interpreted {
    /// `true` for `f64`.
    double: bool,
    deadline: Rc<Cell<Instant>>,
}

impl Runner for Interpreted {
    fn name(&self) -> String {
        match self.double {
            true => "interpreter, f64".to_owned(),
            false => "interpreter, f32".to_owned(),
        }
    }

    fn run_cases(&mut self, kernel: &TestKernel, cases: &[Case]) -> Result<Vec<Outcome>, RunnerError> {
        match self.double {
            true => interpret_cases::<f64>(kernel, cases, self.deadline.get()),
            false => interpret_cases::<f32>(kernel, cases, self.deadline.get()),
        }
    }
}
