//! Steps of `study all`: the commands that take the records of the documents again. `steps.json` lists them; a test compares
//! them with the commands in `study/records`.

mod changes;

use serde::Deserialize;
use std::path::Path;
use std::sync::LazyLock;

pub use changes::Changes;

/// One record, and the command that takes it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// Name of the record, without extension.
    pub record: String,
    /// Arguments of `straightline`, without `--out` and `--record`. `{records}` is the folder of finished records, `{folder}`
    /// that of this step.
    pub arguments: Vec<String>,
    /// Commands that write inputs of the step first, each with its program.
    #[serde(default)]
    pub before: Vec<Vec<String>>,
    /// Stem of the file that the command writes.
    pub writes: String,
    /// Duration in seconds on two cores, roughly.
    pub seconds: u32,
    /// Duration in seconds of the quick form.
    pub quick_seconds: u32,
}

/// A record that another program makes.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OtherRecord {
    /// Name of the record, without extension.
    pub record: String,
    /// Command that makes it.
    pub command: String,
}

/// All records of the documents.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Steps {
    /// Records of this program, each after those that it reads.
    pub steps: Vec<Step>,
    /// Records of other programs.
    pub others: Vec<OtherRecord>,
}

/// Folders of a run.
#[derive(Clone, Copy, Debug)]
pub struct Folders<'a> {
    /// Folder of finished records.
    pub records: &'a Path,
    /// Folder of the step.
    pub own: &'a Path,
}

impl Folders<'_> {
    fn fill(&self, text: &str) -> String {
        let name = |folder: &Path| folder.display().to_string();
        text.replace("{records}", &name(self.records))
            .replace("{folder}", &name(self.own))
    }
}

/// Size and rounds of a quick step.
const QUICK: [&str; 4] = ["--size", "320x180", "--rounds", "3"];

impl Steps {
    /// Returns the steps of the documents' records.
    pub fn list() -> &'static Steps {
        // A test reads them.
        static STEPS: LazyLock<Steps> =
            LazyLock::new(|| serde_json::from_str(include_str!("steps.json")).expect("steps.json"));
        &STEPS
    }
}

impl Step {
    /// Returns the study's name: `loops`, `tune`, …
    pub fn study(&self) -> &str {
        let words = &self.arguments;
        let word = |k: usize| words.get(k).map_or("", String::as_str);
        if word(0) == "study" { word(1) } else { word(0) }
    }

    /// Returns the value of an option of the command.
    pub fn option(&self, name: &str) -> Option<&str> {
        let at = self.arguments.iter().position(|word| word == name)?;
        self.arguments.get(at + 1).map(String::as_str)
    }

    /// Returns the expected duration in seconds.
    pub fn expected_seconds(&self, quick: bool) -> u32 {
        if quick { self.quick_seconds } else { self.seconds }
    }

    /// Returns all arguments of `straightline` for this step.
    pub fn command(&self, quick: bool, folders: Folders<'_>) -> Vec<String> {
        let mut words: Vec<String> = self.arguments.iter().map(|word| folders.fill(word)).collect();
        let study = self.study();
        if quick && !["isa", "frame", "hard", "motion", "film"].contains(&study) {
            for name in ["--size", "--rounds"] {
                if let Some(at) = words.iter().position(|word| word == name) {
                    words.drain(at..at + 2);
                }
            }
            words.extend(QUICK.map(str::to_owned));
        }
        if quick && words[0] == "study" && !words.iter().any(|word| word == "--quick") {
            words.push("--quick".to_owned());
        }
        let out = folders.own.display().to_string();
        match study {
            "budget" | "quads" => words.extend(["--record".to_owned(), format!("{out}/{}.json", self.writes)]),
            _ => words.extend(["--out".to_owned(), out]),
        }
        words
    }

    /// Returns the commands that write the step's inputs, each with its program.
    pub fn inputs(&self, folders: Folders<'_>) -> Vec<Vec<String>> {
        let fill = |command: &Vec<String>| command.iter().map(|word| folders.fill(word)).collect();
        self.before.iter().map(fill).collect()
    }

    /// Returns the files of kernels and models that the command reads, as given from the root of a checkout.
    pub fn files(&self) -> impl Iterator<Item = &str> {
        let words = self.arguments.iter().filter(|word| !word.contains('{'));
        let files = words.map(|word| word.split("::").next().unwrap_or(word));
        files.filter(|word| [".rs", ".glb", ".obj"].iter().any(|kind| word.ends_with(kind)))
    }
}
