//! Error codes: one for each kind of mistake, with the page that explains it.

use std::fmt;

/// Declares the codes: name, number, title. `codes/NUMBER.md` contains the explanation.
macro_rules! codes {
    ($($name:ident = $number:literal, $title:literal;)*) => {
        /// Kind of an error, by which tools and callers distinguish errors.
        ///
        /// Displays as its number, such as `E0301`. The hundreds are the stage: reading and syntax, names and items, types,
        /// unsupported language features, evaluation, options and settings, emission, engines, mistakes in Straightline.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[non_exhaustive]
        pub enum Code {
            $(
                #[doc = concat!($number, ": ", $title, ".")]
                $name,
            )*
        }

        impl Code {
            /// Every code, ordered by number.
            pub const ALL: &[Code] = &[$(Code::$name),*];

            /// Number of the code, such as `E0301`.
            pub fn number(self) -> &'static str {
                match self {
                    $(Code::$name => $number,)*
                }
            }

            /// Short description of the mistake.
            pub fn title(self) -> &'static str {
                match self {
                    $(Code::$name => $title,)*
                }
            }

            /// Explanation in Markdown: the rejected code, the reason, and the code to write instead.
            ///
            /// Code blocks marked with the code's number are rejected with it; unmarked ones are valid kernels.
            pub fn explanation(self) -> &'static str {
                match self {
                    $(Code::$name => include_str!(concat!("codes/", $number, ".md")),)*
                }
            }
        }
    };
}

codes! {
    Syntax = "E0101", "text that is not valid Rust";
    TooDeep = "E0102", "text that is nested too deep or too long";
    UnreadableFile = "E0103", "a kernel file that cannot be read";
    Attribute = "E0104", "an attribute that means nothing where it stands";
    Configuration = "E0105", "a `cfg` that depends on how the crate is built";
    OptionsSyntax = "E0106", "a list of options that cannot be read";

    UnknownName = "E0201", "unknown name";
    UnknownFunction = "E0202", "unknown function";
    UnknownType = "E0203", "unknown type or trait";
    UnknownMethod = "E0204", "unknown method";
    UnknownField = "E0205", "unknown or missing field";
    UnknownVariant = "E0206", "unknown variant";
    UnknownLabel = "E0207", "unknown label";
    MissingFile = "E0208", "an import from a file that was not given";
    DefinedTwice = "E0209", "a name that is defined twice";
    EndlessDefinition = "E0210", "a definition that needs itself";
    UnknownKernel = "E0211", "unknown kernel";
    TraitImplementation = "E0212", "an `impl` that does not match its trait";
    Unassigned = "E0213", "a variable that is used before it has a value";
    Immutable = "E0214", "a change of what cannot be changed";

    MismatchedTypes = "E0301", "mismatched types";
    ArgumentCount = "E0302", "wrong number of arguments";
    NotAFunction = "E0303", "a call of what is no function";
    OperatorTypes = "E0304", "an operator that does not take these types";
    Cast = "E0305", "a cast that loses what it converts";
    IndexType = "E0306", "an index or an indexed value of the wrong type";
    TypeNeeded = "E0307", "a type that nothing states";
    LiteralRange = "E0308", "a literal out of its type's range";
    TraitBound = "E0309", "a trait that the type does not implement";
    NonExhaustive = "E0310", "a `match` that leaves values out";
    RefutablePattern = "E0311", "a pattern that does not take every value";
    Pattern = "E0312", "a pattern that does not fit its value";
    QuestionMark = "E0313", "a `?` where no `Option` or `Result` is";
    VariantForm = "E0314", "a variant that is written in another form than it has";
    DynTrait = "E0315", "a trait that cannot be `dyn`";

    NotInLanguage = "E0401", "Rust that is not part of the kernel language";
    Leaving = "E0402", "a `break`, `continue` or `return` that has no target here";
    KernelParameter = "E0403", "a parameter that a kernel cannot take";
    KernelResult = "E0404", "a result that a kernel cannot give";
    ResourceElement = "E0405", "a resource that no shader can have";
    TextureRead = "E0406", "a read that the texture does not offer";
    MisplacedWrite = "E0407", "a write whose count or order is not defined";
    WorkgroupPhase = "E0408", "a workgroup's phase in the wrong place";
    QuadMessage = "E0409", "a question to other pixels from a kernel of one pixel";
    MutableReference = "E0410", "a mutable reference to no single variable";
    DiffersFromRust = "E0411", "a method that shaders compute differently";
    ChainForm = "E0412", "a chain of passes that cannot be put in order";

    RuntimeIndex = "E0501", "a runtime index where only a constant can be";
    IndexOutOfRange = "E0502", "an index out of range";
    RuntimeValue = "E0503", "a runtime value where a compile-time constant is needed";
    CannotUnroll = "E0504", "a loop that cannot be unrolled";
    CannotStay = "E0505", "a loop that cannot be left in the shader";
    TooManyIterations = "E0506", "a loop of too many iterations";
    Recursion = "E0507", "calls that are nested too deep";
    DivisionByZero = "E0508", "a division by zero";
    Overflow = "E0509", "arithmetic that overflows";
    NarrowUsize = "E0510", "a `usize` whose 64 bits matter";
    Assertion = "E0511", "an assertion that does not hold";
    Unwrap = "E0512", "an `unwrap` that may fail";
    Panic = "E0513", "an operation that panics in Rust";
    TooLarge = "E0514", "a value of too many parts";
    UnlikeValues = "E0515", "a runtime choice between values of different shapes";
    Budget = "E0516", "a kernel that is longer than its budget";
    Limit = "E0517", "a limit of time or memory";

    UnknownOption = "E0601", "unknown option";
    OptionValue = "E0602", "a value that an option cannot have";
    OptionDeclaration = "E0603", "an option that is declared wrongly";
    UnknownLoop = "E0604", "unknown loop";
    SettingValue = "E0605", "a setting with a value that means nothing";
    UnfitSetting = "E0606", "a setting that this kernel cannot have";
    CannotOverride = "E0607", "an option that cannot be overridden";

    VisibleLoss = "E0701", "half precision with a visible loss";
    FrameSize = "E0702", "an engine that does not give the target's size";
    StageUnfit = "E0703", "a stage or form that cannot run the kernel";
    RegionUnfit = "E0704", "a region of a kernel that needs the whole frame";
    NotInTarget = "E0705", "a language without what the kernel needs";
    UnboundedLayers = "E0706", "a layer or sample whose index nothing bounds";
    WorkgroupSize = "E0707", "a workgroup of the wrong size";
    HalfGathers = "E0708", "gathers in half precision";
    Names = "E0709", "too many equal names";
    Binding = "E0710", "a binding that the shader cannot have";
    EntryName = "E0711", "a name that an entry point cannot have";
    FunctionForm = "E0712", "a kernel that cannot be a function";
    LowerLeft = "E0713", "a kernel that cannot count rows from below";
    Untranslated = "E0714", "a language that the translator cannot write";

    EngineUnfit = "E0801", "a kernel that does not fit the engine";

    Internal = "E0901", "a mistake in Straightline";
    InvalidText = "E0902", "an emitted text that a validator refuses";
}

impl Code {
    /// The code with a number, such as `E0301`.
    pub fn from_number(number: &str) -> Option<Code> {
        Code::ALL.iter().copied().find(|code| code.number() == number)
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.number())
    }
}
