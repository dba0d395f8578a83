//! The captions of pictures in `docs/sraa.md` say what the command that is named beside them gives.

use crate::common;

use common::{finishes, here, scratch};

#[test]
fn captions_are_what_their_commands_give() {
    let text = std::fs::read_to_string(here("docs/sraa.md")).expect("the document");
    let folder = scratch("captions");
    for scene in ["grooves", "creases"] {
        let frame = folder.join(scene);
        let frame = frame.to_str().unwrap();
        finishes(&[
            "capture",
            "--scene",
            scene,
            "--size",
            "320x180",
            "--reference",
            "256",
            "--out",
            frame,
        ]);
        let (_, rest) = text.split_once(&format!("]({scene}.png)")).expect("the picture");
        let line = text[..text.len() - rest.len()].lines().last().expect("its caption");
        for (words, metric) in [
            ("planes and normals", "planes-normals"),
            ("depth and normals", "depth-normals"),
            ("normals", "normals"),
            ("depth", "depth"),
        ] {
            let caption = line.split([':', ',']).map(str::trim).find_map(|part| {
                let figure = part.strip_prefix(words)?.strip_prefix(' ')?.split([' ', ']']).next()?;
                figure.parse::<f64>().ok()
            });
            let Some(caption) = caption else { continue };
            let out = folder.join("out.png");
            let option = format!("metric={metric}");
            let said = finishes(&[
                "resolve",
                "--capture",
                frame,
                "--set",
                &option,
                "--reference",
                "--json",
                "--out",
                out.to_str().unwrap(),
            ]);
            let found: serde_json::Value = serde_json::from_str(&said).expect("JSON");
            let found = found["psnr_db"].as_f64().expect("a number");
            println!("{scene}, {metric}: {found:.2}, and the caption says {caption}");
            assert!(
                (found - caption).abs() < 0.06,
                "{scene}, {metric}: {found:.2}, and the caption says {caption}"
            );
        }
    }
}
