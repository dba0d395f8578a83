//! Policies for loops, branches, reads and arithmetic.

use std::fmt;
use std::str::FromStr;

/// Unroll policy of a loop.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Unroll {
    /// Unrolled completely: runs at compile time.
    #[default]
    Full,
    /// Left in the shader where it can be a loop there: the baseline of unroll studies.
    None,
    /// Left in the shader with its body written so many times in a row, at least 2; the remaining iterations follow it.
    Partial(u32),
}

/// Largest factor of a partial unroll.
pub const MAX_FACTOR: u32 = 1024;

impl fmt::Display for Unroll {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unroll::Full => f.write_str("full"),
            Unroll::None => f.write_str("none"),
            Unroll::Partial(n) => write!(f, "partial({n})"),
        }
    }
}

impl FromStr for Unroll {
    type Err = String;

    /// `full`, `none`, `partial(4)` or `4`.
    fn from_str(text: &str) -> Result<Self, String> {
        let factor = text
            .strip_prefix("partial(")
            .and_then(|t| t.strip_suffix(')'))
            .unwrap_or(text);
        match (text, factor.trim().parse::<u32>()) {
            ("full", _) => Ok(Unroll::Full),
            ("none", _) => Ok(Unroll::None),
            (_, Ok(1)) => Ok(Unroll::None),
            (_, Ok(n @ 2..=MAX_FACTOR)) => Ok(Unroll::Partial(n)),
            _ => Err(format!(
                "unknown unroll policy `{text}`: full, none, or partial(N) with N from 2 to {MAX_FACTOR}"
            )),
        }
    }
}

/// Policy for an `if` whose condition is a runtime value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Branches {
    /// As loops do: left as a branch where the unroll policy is not `full`, else both sides are computed and selected from.
    #[default]
    AsLoops,
    /// Kept as a branch.
    Keep,
    /// Both sides are computed and selected from.
    Select,
}

impl fmt::Display for Branches {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Branches::AsLoops => "as-loops",
            Branches::Keep => "keep",
            Branches::Select => "select",
        })
    }
}

impl FromStr for Branches {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "as-loops" => Ok(Branches::AsLoops),
            "keep" => Ok(Branches::Keep),
            "select" => Ok(Branches::Select),
            _ => Err(format!("unknown branch policy `{text}`: as-loops, keep or select")),
        }
    }
}

/// Order in which a block reads texels and elements of buffers. The picture is the same, bit for bit; caches, and compilers that keep the
/// order of the text, may prefer one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ReadOrder {
    /// In the order of the first reads in the source.
    #[default]
    Source,
    /// All whose places depend on nothing that is read come first, row by row of each layer of each texture.
    Rows,
    /// As `Source`, but where several of four texels in a square are wanted, and one component of them, all four are read at once by a
    /// sampler that clamps.
    Gather,
}

impl ReadOrder {
    /// Every order.
    pub const ALL: [ReadOrder; 3] = [ReadOrder::Source, ReadOrder::Rows, ReadOrder::Gather];
}

impl fmt::Display for ReadOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ReadOrder::Source => "source",
            ReadOrder::Rows => "rows",
            ReadOrder::Gather => "gather",
        })
    }
}

impl FromStr for ReadOrder {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = ReadOrder::ALL.into_iter().find(|order| order.to_string() == text);
        known.ok_or_else(|| format!("unknown order of reads `{text}`: source, rows or gather"))
    }
}

/// Sharing between pixels of the texels that they read, besides those that one invocation reads several times. The picture is the same, bit
/// for bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Share {
    /// Nothing: each invocation reads for itself.
    #[default]
    Invocation,
    /// Texels of frame-sized textures at constant offsets from the pixel: a workgroup of so many threads across and down reads them once,
    /// with those around it, into its memory. Compute shaders of single pixels.
    Workgroup([u32; 2]),
}

impl Share {
    /// By workgroups of 16 by 16 threads: few texels lie around so many pixels, and every device has as many threads.
    pub const WORKGROUP: Share = Share::Workgroup([16, 16]);

    /// Replaces the size of the workgroups; no change if pixels share nothing.
    pub fn of_size(self, size: [u32; 2]) -> Share {
        match self {
            Share::Invocation => Share::Invocation,
            Share::Workgroup(_) => Share::Workgroup(size),
        }
    }
}

impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Share::Invocation => f.write_str("invocation"),
            Share::Workgroup([width, height]) => write!(f, "workgroup({width}x{height})"),
        }
    }
}

impl FromStr for Share {
    type Err = String;

    /// `invocation`, `workgroup` or `workgroup(8x8)`.
    fn from_str(text: &str) -> Result<Self, String> {
        let unknown = || format!("unknown sharing `{text}`: invocation, workgroup, or workgroup(WxH)");
        match text {
            "invocation" => return Ok(Share::Invocation),
            "workgroup" => return Ok(Share::WORKGROUP),
            _ => {}
        }
        let size = text.strip_prefix("workgroup(").and_then(|t| t.strip_suffix(')'));
        let (width, height) = size.and_then(|size| size.split_once('x')).ok_or_else(unknown)?;
        match (width.trim().parse(), height.trim().parse()) {
            (Ok(width), Ok(height)) => Ok(Share::Workgroup([width, height])),
            _ => Err(unknown()),
        }
    }
}

/// Algebra permitted with floats.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Math {
    /// Rules that change no bit of the result; and no driver may reorder or contract any operation on floats either.
    Strict,
    /// Rules that change no bit of the result. Sums whose order matters are written so that drivers keep it.
    #[default]
    Exact,
    /// Rules that may change a rounding, too (`docs/semantics.md`): results differ slightly from those of the native function; a test of
    /// the kernel has to decide what difference is acceptable.
    Fast,
}

impl Math {
    /// All of them.
    pub const ALL: [Math; 3] = [Math::Strict, Math::Exact, Math::Fast];
}

impl fmt::Display for Math {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Math::Strict => "strict",
            Math::Exact => "exact",
            Math::Fast => "fast",
        })
    }
}

impl FromStr for Math {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = Math::ALL.into_iter().find(|math| math.to_string() == text);
        known.ok_or_else(|| format!("unknown mathematics `{text}`: strict, exact or fast"))
    }
}

/// Communication between the lanes of a quad.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Transport {
    /// By quad operations, which move bits as they are. Fragment shaders, on devices with subgroups.
    Subgroup,
    /// By fine derivatives, as the chapter does: rounds, and only carries floats. Fragment shaders.
    Derivatives,
    /// Not at all: one invocation computes the four pixels. Compute shaders.
    Block,
}

impl Transport {
    /// Every transport.
    pub const ALL: [Transport; 3] = [Transport::Subgroup, Transport::Derivatives, Transport::Block];
}

impl fmt::Display for Transport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Transport::Subgroup => "subgroup",
            Transport::Derivatives => "derivatives",
            Transport::Block => "block",
        })
    }
}

impl FromStr for Transport {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = Transport::ALL.into_iter().find(|t| t.to_string() == text);
        known.ok_or_else(|| format!("unknown transport `{text}`: subgroup, derivatives or block"))
    }
}

/// Unroll policy of single loops, by the path `function.counter` or by the counter alone.
pub type LoopPolicy = (String, Unroll);

/// Policy requested for a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Asked {
    /// Requested unrolling.
    pub unroll: Unroll,
    /// `true` if the request names the loop, by path or attribute, `false` if it is for all loops.
    pub by_name: bool,
}

/// Policies for a kernel's loops, branches, reads and arithmetic.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Policy {
    /// Of loops of which nothing else is said.
    pub unroll: Unroll,
    /// Of single loops; these go before what the source says, and that before `unroll`.
    pub loops: Vec<LoopPolicy>,
    /// Of branches of which the source says nothing.
    pub branches: Branches,
    /// In which order blocks read.
    pub reads: ReadOrder,
    /// Sharing of texels between pixels.
    pub share: Share,
    /// Algebra permitted with floats.
    pub math: Math,
}

impl Policy {
    /// Refuses factors of partial unrolling that say nothing: 0, 1, and more than [`MAX_FACTOR`].
    ///
    /// # Errors
    ///
    /// What is wrong, in words.
    pub fn check(&self) -> Result<(), String> {
        let all = std::iter::once(("loops", &self.unroll));
        let single = self.loops.iter().map(|(path, unroll)| (path.as_str(), unroll));
        for (what, unroll) in all.chain(single) {
            if let Unroll::Partial(n) = unroll
                && !(2..=MAX_FACTOR).contains(n)
            {
                let what = if what == "loops" {
                    what.to_owned()
                } else {
                    format!("the loop `{what}`")
                };
                return Err(format!(
                    "{what} cannot be unrolled by {n}: a partial unroll writes the body 2 to {MAX_FACTOR} times in a row"
                ));
            }
        }
        for (k, (path, first)) in self.loops.iter().enumerate() {
            if let Some((_, again)) = self.loops[..k].iter().find(|(other, _)| other == path) {
                return Err(format!("the loop `{path}` is given two policies, {again} and {first}"));
            }
        }
        Ok(())
    }

    /// Returns the policy requested for the loop over `counter` in `function`, which has the attribute `attribute` in the source.
    pub fn requested_unroll(&self, function: &str, counter: &str, attribute: Option<Unroll>) -> Asked {
        let named = self
            .loops
            .iter()
            .rev()
            .find(|(path, _)| path_names_loop(path, function, counter));
        let named = named.map(|(_, unroll)| *unroll).or(attribute);
        Asked {
            unroll: named.unwrap_or(self.unroll),
            by_name: named.is_some(),
        }
    }

    /// Returns whether a branch with the attribute `attribute` in the source is kept.
    pub fn keeps_branch(&self, attribute: Option<Branches>) -> bool {
        match attribute.unwrap_or(self.branches) {
            Branches::Keep => true,
            Branches::Select => false,
            Branches::AsLoops => self.unroll != Unroll::Full,
        }
    }
}

/// Returns whether `path` names the loop over `counter` in `function`.
pub fn path_names_loop(path: &str, function: &str, counter: &str) -> bool {
    match path.rsplit_once('.') {
        Some((of, name)) => of == function && name == counter,
        None => path == counter,
    }
}

impl fmt::Display for Policy {
    /// As manifests and headers state it: `none`, `full; sraa.tap partial(3); branches keep`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.unroll)?;
        for (path, unroll) in &self.loops {
            write!(f, "; {path} {unroll}")?;
        }
        if self.branches != Branches::AsLoops {
            write!(f, "; branches {}", self.branches)?;
        }
        if self.reads != ReadOrder::Source {
            write!(f, "; reads {}", self.reads)?;
        }
        if self.share != Share::Invocation {
            write!(f, "; share {}", self.share)?;
        }
        if self.math != Math::Exact {
            write!(f, "; math {}", self.math)?;
        }
        Ok(())
    }
}
