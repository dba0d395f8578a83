//! Order in which choices are tried.

use super::PrecisionError;
use crate::record::{Lowered, Proposal};
use std::collections::BTreeSet;

/// Names of values in half precision.
pub type Choice = BTreeSet<String>;

/// Share by which a proposal for several GPUs may be dearer on one of them.
const DEARER: f64 = 0.01;

/// A choice's error and cost.
pub trait Judge {
    /// Judges a choice; the same choice always alike.
    fn judge(&mut self, half: &Choice) -> Result<Lowered, PrecisionError>;
}

/// Choices that were judged for the reader, and the best ones.
#[derive(Debug)]
pub struct Found {
    /// Full precision, each name by itself, and all names.
    pub choices: Vec<Lowered>,
    /// The cheapest choice for each GPU, and last for all of them.
    pub proposals: Vec<Proposal>,
}

/// Searches the choices of `names`.
pub fn search(judge: &mut dyn Judge, names: &Choice, gpus: &[String], max_error: f64) -> Result<Found, PrecisionError> {
    let mut choices = vec![judge.judge(&Choice::new())?];
    for name in names {
        choices.push(judge.judge(&Choice::from([name.clone()]))?);
    }
    if names.len() > 1 {
        choices.push(judge.judge(names)?);
    }
    let together = (gpus.len() > 1).then(|| gpus.to_vec());
    let goals = gpus.iter().map(|gpu| vec![gpu.clone()]).chain(together);
    let mut proposals = Vec::new();
    for gpus in goals {
        let mut search = Search {
            judge: &mut *judge,
            names,
            gpus: &gpus,
            max_error,
        };
        proposals.push(Proposal {
            lowered: search.run()?,
            gpus,
        });
    }
    Ok(Found { choices, proposals })
}

/// Search of the cheapest choice for some GPUs.
struct Search<'a> {
    judge: &'a mut dyn Judge,
    names: &'a Choice,
    gpus: &'a [String],
    max_error: f64,
}

impl Search<'_> {
    /// A single name rarely pays, since what meets it is converted; so the search also begins with all names.
    fn run(&mut self) -> Result<Lowered, PrecisionError> {
        let within = self.drop_until_within()?;
        let from_many = self.descend(within)?;
        let from_none = self.descend(Choice::new())?;
        let best = match self.cost(&from_none)? <= self.cost(&from_many)? {
            true => from_none,
            false => from_many,
        };
        self.judge.judge(&best)
    }

    fn is_within(&mut self, choice: &Choice) -> Result<bool, PrecisionError> {
        let lowered = self.judge.judge(choice)?;
        Ok(choice.is_empty() || lowered.error.is_some_and(|error| error <= self.max_error))
    }

    /// Geometric mean of the costs; infinite for a choice beyond the bound of the error, or dearer on one of several GPUs.
    fn cost(&mut self, choice: &Choice) -> Result<f64, PrecisionError> {
        if !self.is_within(choice)? {
            return Ok(f64::INFINITY);
        }
        let lowered = self.judge.judge(choice)?;
        let ratios: Vec<f64> = self
            .gpus
            .iter()
            .filter_map(|gpu| lowered.ratios.get(gpu).copied())
            .collect();
        if ratios.len() > 1 && ratios.iter().any(|ratio| *ratio > 1.0 + DEARER) {
            return Ok(f64::INFINITY);
        }
        let logarithms = ratios.iter().map(|ratio| ratio.ln());
        Ok((logarithms.sum::<f64>() / ratios.len().max(1) as f64).exp())
    }

    /// Takes away the name whose absence lowers the error most, until the error keeps its bound.
    fn drop_until_within(&mut self) -> Result<Choice, PrecisionError> {
        let mut chosen = self.names.clone();
        while !self.is_within(&chosen)? {
            let mut best: Option<(f64, Choice)> = None;
            for name in &chosen {
                let mut fewer = chosen.clone();
                fewer.remove(name);
                let error = self.judge.judge(&fewer)?.error.unwrap_or(f64::INFINITY);
                if best.as_ref().is_none_or(|(least, _)| error < *least) {
                    best = Some((error, fewer));
                }
            }
            let Some((_, fewer)) = best else { break };
            chosen = fewer;
        }
        Ok(chosen)
    }

    /// Takes away or adds the name that lowers the cost most, until none does.
    fn descend(&mut self, from: Choice) -> Result<Choice, PrecisionError> {
        let mut chosen = from;
        let mut least = self.cost(&chosen)?;
        loop {
            let mut best = None;
            for name in self.names {
                let mut other = chosen.clone();
                if !other.remove(name) {
                    other.insert(name.clone());
                }
                let cost = self.cost(&other)?;
                if cost < least {
                    least = cost;
                    best = Some(other);
                }
            }
            match best {
                Some(other) => chosen = other,
                None => return Ok(chosen),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    /// Values `a` and `b` pay together on one GPU and cost on the other; `c` is cheap and errs; `d` is not finite.
    struct Made;

    impl Judge for Made {
        fn judge(&mut self, half: &Choice) -> Result<Lowered, PrecisionError> {
            let has = |name: &str| half.contains(name);
            let pair = has("a") && has("b");
            let alone = (has("a") || has("b")) && !pair;
            let first = 1.0 - 0.3 * f64::from(pair) + 0.1 * f64::from(alone) - 0.2 * f64::from(has("c"));
            let second = 1.0 + 0.2 * f64::from(pair) + 0.1 * f64::from(alone) - 0.1 * f64::from(has("c"));
            let error = 0.001 * half.len() as f64 + 0.01 * f64::from(has("c"));
            Ok(Lowered {
                half: half.clone(),
                error: (!has("d")).then_some(error),
                machine: BTreeMap::new(),
                ratios: BTreeMap::from([("first".to_owned(), first), ("second".to_owned(), second)]),
            })
        }
    }

    fn proposed(max_error: f64) -> Vec<String> {
        let names = ["a", "b", "c", "d"].map(str::to_owned).into();
        let gpus = ["first", "second"].map(str::to_owned);
        let found = search(&mut Made, &names, &gpus, max_error).expect("nothing fails");
        assert_eq!(found.choices.len(), 6, "nothing, each, and all");
        let names = |proposal: &Proposal| Vec::from_iter(proposal.lowered.half.iter().cloned()).join(" ");
        found.proposals.iter().map(names).collect()
    }

    #[test]
    fn what_pays_only_together_is_found() {
        assert_eq!(proposed(0.005), ["a b", "", ""]);
    }

    #[test]
    fn the_bound_of_the_error_is_kept() {
        assert_eq!(proposed(0.02), ["a b c", "c", "c"]);
        assert_eq!(proposed(0.0015), ["", "", ""]);
    }
}
