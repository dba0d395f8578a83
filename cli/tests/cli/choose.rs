//! `choose` on the command line: candidates that `build.rs` wrote, compared by a compiler of a GPU.

use crate::common;

use common::{fails, finishes, scratch};
use straightline_codegen::{Config, Unroll};
use straightline_runtime::Choices;

const BLUR: &str = "pub fn blur(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for x in -12..=12 {
        sum += color.load(pixel + ivec2(x, 0));
    }
    sum / 25.0
}";

#[test]
fn the_cheapest_of_each_vendor_is_added_to_the_choices() {
    let folder = scratch("choose");
    std::fs::write(folder.join("blur.rs"), BLUR).expect("written");
    let config = Config::new().out_dir(&folder).file_with(folder.join("blur.rs"), |k| {
        k.unroll(Unroll::None)
            .candidate("unrolled", |s| s.unroll(Unroll::Full))
            .candidate("blocks", |s| s.block(2, 1))
    });
    config.compile().unwrap_or_else(|e| panic!("{e}"));
    let (list, out) = (folder.join("blur.candidates.txt"), folder.join("choices.txt"));
    let (list, out) = (list.to_str().expect("a path"), out.to_str().expect("a path"));
    let text = finishes(&["choose", list, "--isa", "amd:navi21,amd:navi10", "--out", out]);
    for part in [
        "AMD: ",
        "candidate",
        "amd:navi21, cycles",
        "amd:navi10, cycles",
        "default",
        "unrolled",
        "blocks",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let choices = Choices::read(out.as_ref()).expect("choices");
    let [one] = &choices.iter().collect::<Vec<_>>()[..] else {
        panic!("{choices}");
    };
    assert_eq!((one.kernel.as_str(), one.device.as_str()), ("blur", "vendor 1002"));
    assert!(text.contains(&format!("AMD: {}", one.name)), "{text}\n{choices}");
    assert!(one.times.contains("amd:navi10 default "), "{}", one.times);
    // Asked again, it replaces the vendor's choice.
    finishes(&["choose", list, "--isa", "amd:navi21", "--out", out]);
    assert_eq!(Choices::read(out.as_ref()).expect("choices").iter().len(), 1);
}

#[test]
fn what_is_no_list_is_refused_with_the_place_of_one() {
    let folder = scratch("choose-refused");
    let path = |name: &str| folder.join(name).to_str().expect("a path").to_owned();
    let (none, bad, away) = (path("none.txt"), path("bad.txt"), path("away.txt"));
    std::fs::write(&bad, "default\n").expect("written");
    std::fs::write(&away, "default ../blur\n").expect("written");
    let isa = ["--isa", "amd:navi21"];
    fails(&["choose", &none, isa[0], isa[1]], 1, &["cannot read", "none.txt"]);
    fails(
        &["choose", &bad, isa[0], isa[1]],
        1,
        &["no list of candidates", "NAME.candidates.txt"],
    );
    fails(
        &["choose", &away, isa[0], isa[1]],
        1,
        &["no list of candidates", "../blur"],
    );
    fails(&["choose", &bad, "--isa", "matrox"], 2, &["no such GPU"]);
}
