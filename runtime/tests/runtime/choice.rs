//! Choices between candidates: what is timed, remembered and refused.

use crate::common::{COLOR, Fixture, Gpu, Kernel, Stage, ramp, view};
use straightline_runtime::{Candidate, Choices, Error, PassOptions, Reason, Shader};

const SIZE: [u32; 2] = [64, 64];

/// `color` after a loop that changes nothing.
const SLOW: Kernel = Kernel {
    name: "copy",
    bindings: &[COLOR],
    declarations: "@group(0) @binding(0) var color: texture_2d<f32>;
        fn spin(x: vec4f) -> vec4f {
            var y = x;
            for (var k = 0; k < 20000; k++) { y = sqrt(y * y + f32(k)) * sqrt(y + 1.0); y = min(y, x); }
            return max(y, x);
        }",
    result: "spin(textureLoad(color, pixel, 0))",
};

/// A kernel whose text needs a feature that the device lacks.
const HALF: Kernel = Kernel {
    name: "copy",
    bindings: &[COLOR],
    declarations: "@group(0) @binding(0) var color: texture_2d<f32>;",
    result: "textureLoad(color, pixel, 0) + 0.0",
};

/// Fixtures of the candidates `slow`, `fast` and `half`.
fn fixtures() -> [Fixture; 3] {
    let mut half = HALF.emit(Stage::Compute);
    half.manifest = half.manifest.replacen('{', r#"{"features": ["shader-f16"], "#, 1);
    [
        SLOW.emit(Stage::Compute),
        crate::common::COPY.emit(Stage::Compute),
        half,
    ]
}

#[test]
fn the_fastest_is_timed_once_and_remembered() {
    let gpu = Gpu::new();
    let (color, target) = (gpu.upload(SIZE, 1, &ramp(SIZE, 1)), gpu.target(SIZE));
    let fixtures = fixtures();
    let shaders = fixtures
        .each_ref()
        .map(|f| Shader::from_json(&f.manifest, &f.wgsl).expect("a shader"));
    let [slow, fast, half] = shaders.each_ref();
    let candidates = [("half", half), ("slow", slow), ("fast", fast)].map(|(name, shader)| Candidate { name, shader });
    let mut choices = Choices::new();
    let choose = |choices: &mut Choices, candidates: &[Candidate<'_>]| {
        let mut bound = 0;
        let chosen = choices.choose((&gpu.device, &gpu.queue), candidates, &PassOptions::default(), |pass| {
            bound += 1;
            pass.bind(&[("color", &view(&color))], &view(&target))
        });
        (chosen.expect("a choice"), bound)
    };

    let (chosen, bound) = choose(&mut choices, &candidates);
    assert_eq!((chosen.name.as_str(), chosen.reason, bound), ("fast", Reason::Timed, 2));
    let [(name, Error::Pipeline { description, .. })] = &chosen.skipped[..] else {
        panic!("{:?}", chosen.skipped);
    };
    assert!(name == "half" && description.contains("SHADER_F16"), "{description}");
    assert_eq!(gpu.download(&target), ramp(SIZE, 1), "it ran");

    let (chosen, bound) = choose(&mut choices, &candidates);
    assert_eq!(
        (chosen.name.as_str(), chosen.reason, bound),
        ("fast", Reason::Remembered, 0)
    );
    assert_eq!(chosen.pass.kernel(), "copy");

    // Through a text, as a program ships it.
    let text = choices.to_string();
    let mut read: Choices = text.parse().expect("its own text");
    assert_eq!(read, choices);
    let one = read.iter().next().expect("a choice");
    assert_eq!((one.kernel.as_str(), one.name.as_str()), ("copy", "fast"));
    assert!(
        one.times.contains("slow ") && one.times.contains(" ms, fast "),
        "{text}"
    );
    assert_eq!(one.device, Choices::device_name(&gpu.device));
    // Other candidates are another choice.
    let (chosen, bound) = choose(&mut read, &candidates[..2]);
    assert_eq!(
        (chosen.name.as_str(), chosen.reason, bound),
        ("slow", Reason::Untimed, 0)
    );
    let (chosen, _) = choose(&mut read, &[candidates[2], candidates[1]]);
    assert_eq!((chosen.name.as_str(), chosen.reason), ("fast", Reason::Timed));
    assert_eq!(read.iter().len(), 2);
    // Choices that are there precede added ones.
    let mut added = Choices::new();
    added.add(read);
    added.add(text.replace("\tfast\t", "\tslow\t").parse().expect("a text"));
    assert_eq!(
        added.iter().map(|one| one.name.as_str()).collect::<Vec<_>>(),
        ["fast", "fast"]
    );
}

#[test]
fn a_vendor_s_choice_holds_where_the_device_has_none() {
    let gpu = Gpu::new();
    let fixtures = fixtures();
    let shaders = fixtures
        .each_ref()
        .map(|f| Shader::from_json(&f.manifest, &f.wgsl).expect("a shader"));
    let candidates = [("fast", &shaders[1]), ("slow", &shaders[0])].map(|(name, shader)| Candidate { name, shader });
    let vendor = gpu.device.adapter_info().vendor;
    let mut choices = Choices::new();
    choices.add_for_vendor(vendor, &candidates, "slow", "by hand");
    choices.add_for_vendor(vendor + 1, &candidates, "fast", "by hand");
    let found = |choices: &Choices| choices.find(&gpu.device, &candidates).map(|one| one.name.clone());
    assert_eq!(found(&choices).as_deref(), Some("slow"));
    let options = PassOptions::default();
    let unasked = |_: &_| panic!("nothing is timed");
    let chosen = choices.choose((&gpu.device, &gpu.queue), &candidates, &options, unasked);
    assert_eq!(chosen.expect("a choice").reason, Reason::Remembered);
    let own = choices
        .to_string()
        .replace(&format!("vendor {vendor:04x}"), &Choices::device_name(&gpu.device));
    let mut own: Choices = own.replace("\tslow\t", "\tfast\t").parse().expect("a text");
    own.add(choices);
    assert_eq!(found(&own).as_deref(), Some("fast"));
}

#[test]
fn damaged_texts_and_empty_sets_are_errors() {
    let refused = |text: &str| match text.parse::<Choices>() {
        Err(error @ Error::Choices { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    };
    assert!(refused("").contains("line 1 of the choices cannot be read: it has to be"));
    let text = |line: &str| format!("# straightline choices 1\n\n# a comment\n{line}\n");
    assert!(refused(&text("blur\t0123456789abcdef\tgpu\tfast")).contains("line 4"));
    assert!(refused(&text("blur\t0123\tgpu\tfast\t")).contains("no hash"));
    let read: Choices = text("blur\t0123456789abcdef\tgpu\tfast\t1 ms")
        .parse()
        .expect("a choice");
    assert_eq!(read.iter().len(), 1);

    let gpu = Gpu::new();
    let nothing = Choices::new().choose((&gpu.device, &gpu.queue), &[], &PassOptions::default(), |_| {
        panic!("none")
    });
    assert!(matches!(nothing, Err(Error::NoCandidates)), "{nothing:?}");

    let folder = std::env::temp_dir().join(format!("straightline-choices-{}", std::process::id()));
    let file = folder.join("choices.txt");
    assert_eq!(Choices::read(&file).expect("none yet"), Choices::new());
    read.write(&file).expect("a folder");
    assert_eq!(Choices::read(&file).expect("its own"), read);
    assert!(matches!(Choices::read(&folder), Err(Error::Read { .. })));
    std::fs::remove_dir_all(&folder).expect("removed");
}
