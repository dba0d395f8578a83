//! `watch`: a file is edited, and its shader and picture follow.

use crate::common;

use common::{fails, scratch, write};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

/// Longest wait for a line: the machine may be busy.
const PATIENCE: Duration = Duration::from_secs(60);

/// A running `watch`. It is ended when this is dropped, whatever a test found.
struct Watch {
    child: Child,
    /// Lines that the command prints on both streams.
    lines: Receiver<String>,
}

impl Watch {
    fn start(arguments: &[&str]) -> Watch {
        let mut child = Command::new(env!("CARGO_BIN_EXE_straightline"))
            .arg("watch")
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the binary runs");
        let (sender, lines) = channel();
        let streams: [Box<dyn std::io::Read + Send>; 2] = [
            Box::new(child.stdout.take().expect("a pipe")),
            Box::new(child.stderr.take().expect("a pipe")),
        ];
        for stream in streams {
            let sender = sender.clone();
            std::thread::spawn(move || {
                for line in BufReader::new(stream).lines().map_while(Result::ok) {
                    let _ = sender.send(line);
                }
            });
        }
        Watch { child, lines }
    }

    /// Waits for a line with this text.
    fn says(&self, text: &str) -> String {
        let mut before = Vec::new();
        loop {
            match self.lines.recv_timeout(PATIENCE) {
                Ok(line) if line.contains(text) => return line,
                Ok(line) => before.push(line),
                Err(_) => panic!("it does not say `{text}` but: {before:#?}"),
            }
        }
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn kernel(body: &str) -> String {
    format!("pub fn k(pixel: IVec2) -> Vec4 {{\n    {body}\n}}\n")
}

#[test]
fn shader_and_picture_follow_the_file() {
    let folder = scratch("watch");
    let path = |name: &str| folder.join(name).display().to_string();
    let file = write(&folder, "k.rs", &kernel("Vec4::splat(pixel.x as f32) * 0.125"));
    let (out, picture) = (path("shaders"), path("k.png"));
    let watch = Watch::start(&[
        &file,
        "--out",
        &out,
        "--picture",
        &picture,
        "--size",
        "16x9",
        "--executor",
        "cpu",
    ]);
    let read = || {
        (
            std::fs::read_to_string(folder.join("shaders/k.wgsl")).expect("a shader"),
            std::fs::read(&picture).expect("a picture"),
        )
    };
    let first = watch.says("k: wrote ");
    assert!(
        first.contains("k.wgsl") && first.contains("k.png") && first.contains(" ms"),
        "{first}"
    );
    let (shader, pixels) = read();
    assert!(shader.contains("0.125"), "{shader}");

    // An error is reported, and leaves the files as they were.
    write(&folder, "k.rs", &kernel("Vec4::splat(pixel.x as f32) * true"));
    watch.says("cannot apply `*`");
    assert_eq!(read(), (shader, pixels.clone()));

    // Saved as some editors do: another file takes its place.
    write(&folder, "k.rs.new", &kernel("Vec4::splat(pixel.x as f32) * 0.625"));
    std::fs::rename(folder.join("k.rs.new"), &file).expect("renamed");
    watch.says("k: wrote ");
    let (shader, changed) = read();
    assert!(shader.contains("0.625") && changed != pixels, "{shader}");

    // A file that is gone is reported, and followed when it is back.
    std::fs::remove_file(&file).expect("removed");
    watch.says("cannot read the kernel file");
    write(&folder, "k.rs", &kernel("Vec4::splat(pixel.x as f32) * 0.375"));
    watch.says("k: wrote ");
    assert!(read().0.contains("0.375"));
}

#[test]
fn further_sources_are_watched_and_an_interrupt_ends_it() {
    let folder = scratch("watch-sources");
    let file = write(&folder, "k.rs", &kernel("weighed(Vec4::splat(pixel.x as f32))"));
    let source = |factor: &str| {
        let text = format!("pub fn weighed(x: Vec4) -> Vec4 {{\n    x * {factor}\n}}\n");
        write(&folder, "weighed.rs", &text)
    };
    let other = source("0.125");
    let out = folder.join("shaders").display().to_string();
    let mut watch = Watch::start(&[&file, "--source", &other, "--out", &out, "--target", "wgsl,hlsl"]);
    watch.says("k.hlsl");
    source("0.25");
    watch.says("k.hlsl");
    let text = std::fs::read_to_string(Path::new(&out).join("k.hlsl")).expect("a shader");
    assert!(text.contains("0.25"), "{text}");
    #[cfg(unix)]
    {
        let pid = watch.child.id().to_string();
        assert!(
            Command::new("kill")
                .args(["-INT", &pid])
                .status()
                .expect("kill runs")
                .success()
        );
        assert_eq!(watch.child.wait().expect("it ends").code(), Some(130));
        let names = std::fs::read_dir(&out)
            .expect("a folder")
            .map(|entry| entry.expect("an entry").file_name());
        let mut names: Vec<_> = names.collect();
        names.sort();
        assert_eq!(names, ["k.hlsl", "k.json", "k.wgsl"]);
    }
}

#[test]
fn what_cannot_be_watched_is_refused() {
    let folder = scratch("watch-refused");
    let out = folder.join("out").display().to_string();
    let file = write(&folder, "k.rs", &kernel("Vec4::splat(pixel.x as f32)"));
    fails(&["watch", "sraa", "--out", &out], 2, &["`sraa` is no file", "FILE.rs"]);
    fails(
        &["watch", "nowhere.rs", "--out", &out],
        2,
        &["cannot read the kernel file `nowhere.rs`"],
    );
    fails(&["watch", &file, "--out", &out, "--size", "4x4"], 2, &["add --picture"]);
    fails(&["watch", &file], 2, &["--out"]);
    assert!(!Path::new(&out).exists());
}
