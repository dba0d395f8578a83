//! Contradictions in the plan of a chain.

use super::{CHAIN_SCHEMA, ChainPlan, PicturePlan};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// Most inputs, pictures, and passes of a chain: looking up names takes time that grows with the square.
const MOST: usize = 1024;

/// A plan of a chain that contradicts itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadChain {
    /// The part of the plan, such as ``picture `half` ``.
    pub place: String,
    /// The problem there.
    pub problem: String,
}

impl fmt::Display for BadChain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.problem)
    }
}

impl std::error::Error for BadChain {}

/// Passes during which a picture is needed.
struct Life {
    written: usize,
    /// The last pass that reads it, or the one that writes it.
    last: usize,
}

impl ChainPlan {
    /// Checks that the chain can run: every name is known and stands for one thing, pictures are written once and read
    /// later, rules yield sizes, and pictures that share memory fit it and are never needed together.
    ///
    /// # Errors
    ///
    /// The first contradiction.
    pub fn check(&self) -> Result<(), BadChain> {
        if self.schema != CHAIN_SCHEMA {
            let problem = format!("{}, but this reader knows schema {CHAIN_SCHEMA}", self.schema);
            return Err(bad("schema".to_owned(), problem));
        }
        let counts = [
            ("inputs", self.inputs.len()),
            ("pictures", self.pictures.len()),
            ("passes", self.passes.len()),
        ];
        if let Some((place, count)) = counts.into_iter().find(|(_, count)| *count > MOST) {
            return Err(bad(place.to_owned(), format!("{count}, more than {MOST}")));
        }
        let inputs = self.check_names()?;
        self.check_rules(&inputs)?;
        let lives = self.check_passes(&inputs)?;
        if self.results().next().is_none() {
            return Err(bad("pictures".to_owned(), "none is a result".to_owned()));
        }
        self.check_memory(&lives)
    }

    /// Checks that no two things have one name, and returns those of the inputs.
    fn check_names(&self) -> Result<BTreeSet<&str>, BadChain> {
        let mut inputs = BTreeSet::new();
        for input in self.inputs.iter() {
            if !inputs.insert(&**input) {
                return Err(bad(format!("input `{input}`"), "is listed twice".to_owned()));
            }
        }
        let mut pictures = BTreeSet::new();
        for PicturePlan { name, .. } in self.pictures.iter() {
            let problem = match (inputs.contains(&**name), pictures.insert(&**name)) {
                (true, _) => "an input has this name too",
                (_, false) => "is listed twice",
                (false, true) => continue,
            };
            return Err(bad(format!("picture `{name}`"), problem.to_owned()));
        }
        let mut passes = BTreeSet::new();
        match self.passes.iter().find(|pass| !passes.insert(&*pass.name)) {
            Some(pass) => Err(bad(format!("pass `{}`", pass.name), "is listed twice".to_owned())),
            None => Ok(inputs),
        }
    }

    /// Checks that each rule yields a size.
    fn check_rules(&self, inputs: &BTreeSet<&str>) -> Result<(), BadChain> {
        for PicturePlan { name, size, .. } in self.pictures.iter() {
            let yields = size.evaluate(&|input| inputs.contains(input).then_some([1, 1]));
            yields.map_err(|wrong| bad(format!("size of picture `{name}`"), wrong.to_string()))?;
        }
        Ok(())
    }

    /// Checks what each pass reads and writes, and returns when each picture is needed, in their order.
    fn check_passes(&self, inputs: &BTreeSet<&str>) -> Result<Vec<Life>, BadChain> {
        let mut numbers = BTreeMap::new();
        for (number, picture) in self.pictures.iter().enumerate() {
            numbers.insert(&*picture.name, number);
        }
        let mut lives: Vec<Option<Life>> = self.pictures.iter().map(|_| None).collect();
        for (k, pass) in self.passes.iter().enumerate() {
            let wrong = |problem: String| bad(format!("pass `{}`", pass.name), problem);
            let mut names = BTreeSet::new();
            for read in pass.reads.iter() {
                if !names.insert(&*read.name) {
                    return Err(wrong(format!("reads two things as `{}`", read.name)));
                }
                let picture = numbers.get(&*read.from);
                match picture.map(|picture| &mut lives[*picture]) {
                    Some(Some(life)) => life.last = k,
                    Some(None) => return Err(wrong(format!("reads `{}` before it is written", read.from))),
                    None if inputs.contains(&*read.from) => {}
                    None => return Err(wrong(format!("reads `{}`, which nothing has the name of", read.from))),
                }
            }
            for name in pass.writes.iter() {
                let Some(number) = numbers.get(&**name) else {
                    return Err(wrong(format!("writes `{name}`, which is no picture")));
                };
                if lives[*number].is_some() {
                    return Err(wrong(format!("writes `{name}`, which is written already")));
                }
                lives[*number] = Some(Life { written: k, last: k });
            }
            if pass.writes.is_empty() {
                return Err(wrong("writes nothing".to_owned()));
            }
        }
        let named = self.pictures.iter().zip(lives);
        let written = named.map(|(picture, life)| {
            life.ok_or_else(|| bad(format!("picture `{}`", picture.name), "no pass writes it".to_owned()))
        });
        written.collect()
    }

    /// Checks the pictures of each memory number against one another.
    fn check_memory(&self, lives: &[Life]) -> Result<(), BadChain> {
        let mut order: Vec<(&PicturePlan, &Life)> = self.pictures.iter().zip(lives).collect();
        order.sort_by_key(|(_, life)| life.written);
        let mut latest: BTreeMap<u32, (&PicturePlan, &Life)> = BTreeMap::new();
        for (picture, life) in order {
            let Some(memory) = picture.memory else { continue };
            let Some((other, earlier)) = latest.insert(memory, (picture, life)) else {
                continue;
            };
            let problem = if picture.size != other.size {
                "their sizes are unlike"
            } else if picture.format != other.format {
                "their formats are unlike"
            } else if life.written <= earlier.last {
                "both are needed at one time"
            } else {
                continue;
            };
            let place = format!("memory {memory} of `{}` and `{}`", other.name, picture.name);
            return Err(bad(place, problem.to_owned()));
        }
        Ok(())
    }
}

fn bad(place: String, problem: String) -> BadChain {
    BadChain { place, problem }
}

#[cfg(test)]
mod tests {
    use crate::Format;
    use crate::chain::{CHAIN_SCHEMA, ChainPlan, PassPlan, PicturePlan, ReadPlan, SizeOp, SizeRule, SizeTerm};

    fn picture(name: &'static str, divisor: u32, memory: Option<u32>) -> PicturePlan {
        let terms = vec![
            SizeTerm::Of("color".into()),
            SizeTerm::Number([divisor; 2]),
            SizeTerm::Apply(SizeOp::Div),
        ];
        PicturePlan {
            name: name.into(),
            size: SizeRule(terms.into()),
            format: Format::Rgba16Float,
            memory,
        }
    }

    fn pass(reads: &[&'static str], writes: &[&'static str]) -> PassPlan {
        let read = |name: &&'static str| ReadPlan {
            name: (*name).into(),
            from: (*name).into(),
        };
        PassPlan {
            name: writes.first().copied().unwrap_or_default().into(),
            shader: "shader".into(),
            reads: reads.iter().map(read).collect(),
            writes: writes.iter().map(|name| (*name).into()).collect(),
        }
    }

    /// `color` to `a`, `b`, `c`, of which `a` and `c` share memory, and `out`.
    fn good() -> ChainPlan {
        ChainPlan {
            schema: CHAIN_SCHEMA,
            chain: "chain".into(),
            inputs: vec!["color".into()].into(),
            pictures: vec![
                picture("a", 2, Some(0)),
                picture("b", 4, Some(7)),
                picture("c", 2, Some(0)),
                picture("out", 1, None),
            ]
            .into(),
            passes: vec![
                pass(&["color"], &["a"]),
                pass(&["a"], &["b"]),
                pass(&["b"], &["c"]),
                pass(&["c", "color"], &["out"]),
            ]
            .into(),
        }
    }

    #[test]
    fn a_chain_without_contradictions_passes() {
        assert_eq!(good().check(), Ok(()));
    }

    #[test]
    fn each_contradiction_is_named() {
        type Break = fn(&mut ChainPlan);
        let cases: [(Break, &str); 20] = [
            (|c| c.schema = 2, "schema: 2, but this reader knows schema 1"),
            (
                |c| c.inputs = vec!["x".into(); 1025].into(),
                "inputs: 1025, more than 1024",
            ),
            (
                |c| c.inputs.to_mut().push("color".into()),
                "input `color`: is listed twice",
            ),
            (
                |c| c.pictures.to_mut()[1].name = "color".into(),
                "picture `color`: an input has this name too",
            ),
            (
                |c| c.pictures.to_mut()[1].name = "a".into(),
                "picture `a`: is listed twice",
            ),
            (|c| c.passes.to_mut()[1].name = "a".into(), "pass `a`: is listed twice"),
            (
                |c| c.pictures.to_mut()[0].size.0 = vec![].into(),
                "size of picture `a`: 0 sizes, not one",
            ),
            (
                |c| c.inputs.to_mut()[0] = "other".into(),
                "size of picture `a`: `color` has no size",
            ),
            (
                |c| c.passes.to_mut().swap(0, 1),
                "pass `b`: reads `a` before it is written",
            ),
            (
                |c| c.passes.to_mut()[1].reads.to_mut()[0].from = "b".into(),
                "pass `b`: reads `b` before it is written",
            ),
            (
                |c| c.passes.to_mut()[1].reads.to_mut()[0].from = "x".into(),
                "pass `b`: reads `x`, which nothing has the name of",
            ),
            (
                |c| c.passes.to_mut()[3].reads.to_mut()[1].name = "c".into(),
                "pass `out`: reads two things as `c`",
            ),
            (
                |c| c.passes.to_mut()[1].writes.to_mut()[0] = "x".into(),
                "pass `b`: writes `x`, which is no picture",
            ),
            (
                |c| c.passes.to_mut()[1].writes.to_mut()[0] = "color".into(),
                "pass `b`: writes `color`, which is no picture",
            ),
            (
                |c| c.passes.to_mut()[1].writes.to_mut()[0] = "a".into(),
                "pass `b`: writes `a`, which is written already",
            ),
            (
                |c| c.passes.to_mut()[1].writes.to_mut().push("c".into()),
                "pass `c`: writes `c`, which is written already",
            ),
            (
                |c| c.passes.to_mut()[3].writes = vec![].into(),
                "pass `out`: writes nothing",
            ),
            (
                |c| c.pictures.to_mut().push(picture("d", 1, None)),
                "picture `d`: no pass writes it",
            ),
            (
                |c| c.pictures.to_mut()[3].memory = Some(1),
                "pictures: none is a result",
            ),
            (
                |c| c.pictures.to_mut()[3].memory = Some(0),
                "memory 0 of `c` and `out`: their sizes are unlike",
            ),
        ];
        for (number, (change, wanted)) in cases.into_iter().enumerate() {
            let mut chain = good();
            if number == 19 {
                // So that there is a result all the same.
                chain.pictures.to_mut().push(picture("last", 1, None));
                chain.passes.to_mut().push(pass(&["out"], &["last"]));
            }
            change(&mut chain);
            let found = chain.check().map_err(|wrong| wrong.to_string());
            assert_eq!(found, Err(wanted.to_owned()));
        }
    }

    #[test]
    fn pictures_of_one_memory_fit_and_take_turns() {
        let found = |change: fn(&mut ChainPlan)| {
            let mut chain = good();
            change(&mut chain);
            chain.check().expect_err("a contradiction").to_string()
        };
        let format = found(|c| c.pictures.to_mut()[2].format = Format::Rgba8Unorm);
        assert_eq!(format, "memory 0 of `a` and `c`: their formats are unlike");
        // `a` is read in the pass that writes `c`, and after it.
        for reader in [2, 3] {
            let mut chain = good();
            let reads = chain.passes.to_mut()[reader].reads.to_mut();
            reads.push(ReadPlan {
                name: "more".into(),
                from: "a".into(),
            });
            let found = chain.check().expect_err("a contradiction").to_string();
            assert_eq!(found, "memory 0 of `a` and `c`: both are needed at one time");
        }
        // Two outputs of one pass.
        let both = found(|c| {
            c.passes.to_mut()[2].writes = vec![].into();
            c.passes.to_mut()[0].writes.to_mut().push("c".into());
            c.passes.to_mut()[2] = c.passes[3].clone();
            c.passes.to_mut().pop();
        });
        assert_eq!(both, "memory 0 of `a` and `c`: both are needed at one time");
    }
}
