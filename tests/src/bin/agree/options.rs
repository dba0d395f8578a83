//! Options of the program.

use straightline_tests::random::make::Features;
use straightline_tests::random::oracle::Ways;

/// Options and their defaults.
pub const USAGE: &str = "\
usage: agree [--kernels N] [--seed S] [--threads T] [--batch N] [--without FEATURE]... [--accepts N] [--gpu N]
             [--chains N] [--gpu-languages] [--languages N] [--world W] [--front-minutes M] [--keep-going] [--print]
  --kernels N        random kernels to compare with what rustc makes of them (1000)
  --seed S           number of the first (1)
  --threads T        threads (one for each core)
  --world W          number of the inputs (that of a batch's first kernel)
  --batch N          kernels that rustc compiles at once (400)
  --without FEATURE  leave out a group of constructs
  --accepts N        kernels with a mistake in them, which rustc and the generator must both refuse (0)
  --chains N         random chains of passes to compare with what rustc makes of them, stored, fused and looped (0)
  --gpu N            random kernels to run on a Vulkan adapter, against rustc (0)
  --gpu-languages    run each in one of the forms, as WGSL and as GLSL, instead of in all of them as WGSL
  --languages N      random kernels to emit in every language, each in one form, for the languages' compilers to read (0)
  --front-minutes M  time for mutated texts (0)
  --keep-going       list every disagreement by its seed, instead of making the first smaller
  --print            only print the kernel of the seed, and why it is refused if it is";

/// Options of the program.
pub struct Options {
    /// Random kernels to compare with rustc.
    pub kernels: u64,
    /// The number of the first.
    pub seed: u64,
    /// Threads, 0 for one a core.
    pub threads: usize,
    /// Kernels that rustc compiles at once.
    pub batch: u64,
    /// The number of the inputs, unless it is that of a batch's first kernel.
    pub world: Option<u64>,
    /// Features that kernels are made of.
    pub features: Features,
    /// Kernels with a mistake in them.
    pub accepts: u64,
    /// Random chains to compare with rustc.
    pub chains: u64,
    /// Random kernels to run on a Vulkan adapter.
    pub gpu: u64,
    /// Ways in which each kernel is compiled and run.
    pub ways: Ways,
    /// Random kernels to emit in every language.
    pub languages: u64,
    /// Minutes for mutated texts.
    pub front_minutes: f64,
    /// `true` to list every disagreement.
    pub keep_going: bool,
    /// `true` to print the kernel of the seed, and stop.
    pub print: bool,
}

/// The options that the program was called with, unless they are wrong.
pub fn options() -> Option<Options> {
    let mut options = Options {
        kernels: 1000,
        seed: 1,
        threads: 0,
        batch: 400,
        world: None,
        features: Features::all(),
        accepts: 0,
        chains: 0,
        gpu: 0,
        ways: Ways::Forms,
        languages: 0,
        front_minutes: 0.0,
        keep_going: false,
        print: false,
    };
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        match word.as_str() {
            "--kernels" => options.kernels = words.next()?.parse().ok()?,
            "--seed" => options.seed = words.next()?.parse().ok()?,
            "--threads" => options.threads = words.next()?.parse().ok()?,
            "--world" => options.world = Some(words.next()?.parse().ok()?),
            "--batch" => options.batch = words.next()?.parse().ok().filter(|n| *n > 0)?,
            "--without" => options.features = options.features.without(Features::named(&words.next()?)?),
            "--accepts" => options.accepts = words.next()?.parse().ok()?,
            "--chains" => options.chains = words.next()?.parse().ok()?,
            "--gpu" => options.gpu = words.next()?.parse().ok()?,
            "--gpu-languages" => options.ways = Ways::Languages,
            "--languages" => options.languages = words.next()?.parse().ok()?,
            "--front-minutes" => options.front_minutes = words.next()?.parse().ok()?,
            "--keep-going" => options.keep_going = true,
            "--print" => options.print = true,
            _ => return None,
        }
    }
    Some(options)
}
