use super::*;

fn scratch_folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("straightline-files-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn file_set(list: &[(&str, &str)]) -> BTreeMap<String, Vec<u8>> {
    list.iter()
        .map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec()))
        .collect()
}

fn entry_names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn a_set_is_whole_or_not_there() {
    let folder = scratch_folder("set");
    let out = folder.join("a/b");
    // A folder where the second file should be.
    fs::create_dir_all(folder.join("old/two")).unwrap();
    fs::write(folder.join("old/one"), "before").unwrap();
    let error = write_all(&folder.join("old"), &file_set(&[("one", "after"), ("two", "2")])).unwrap_err();
    assert!(error.to_string().contains("two"), "{error}");
    assert_eq!(fs::read_to_string(folder.join("old/one")).unwrap(), "before");
    assert_eq!(entry_names(&folder.join("old")), ["one", "two"]);
    // A name that leads through a file: the folders that were made for the set are gone again.
    let error = write_all(&out, &file_set(&[("one", "1"), ("one/two", "2")])).unwrap_err();
    assert!(error.to_string().contains("one"), "{error}");
    assert!(!folder.join("a").exists(), "an empty folder is left");
    let written = write_all(&out, &file_set(&[("one", "1"), ("more/two", "2")])).unwrap();
    assert_eq!(written, [out.join("more/two"), out.join("one")]);
    assert_eq!(entry_names(&out), ["more", "one"]);
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_move_that_fails_is_undone() {
    let folder = scratch_folder("move");
    fs::write(folder.join("one"), "before").unwrap();
    let stage = |name: &str| {
        let path = folder.join(name);
        let scrap = Scrap::beside(&path, "partial").unwrap();
        fs::write(scrap.path(), "after").unwrap();
        (scrap, path)
    };
    let staged = [stage("new"), stage("one"), stage("two")];
    fs::create_dir_all(folder.join("two/full")).unwrap();
    assert!(put_in_place(&staged).is_err());
    drop(staged);
    assert_eq!(fs::read_to_string(folder.join("one")).unwrap(), "before");
    assert_eq!(entry_names(&folder), ["one", "two"]);
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn trying_leaves_nothing_behind() {
    let folder = scratch_folder("try");
    try_folder(&folder.join("deep/deeper")).unwrap();
    try_file(&folder.join("deep/file.json"), true).unwrap();
    assert!(try_file(&folder.join("deep/file.json"), false).is_err());
    assert_eq!(entry_names(&folder), [""; 0]);
    fs::write(folder.join("file"), "").unwrap();
    assert!(try_folder(&folder.join("file")).is_err());
    assert!(try_folder(&folder.join("file/below")).is_err());
    assert!(try_file(&folder, true).is_err());
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
#[cfg(unix)]
fn only_regular_files_of_a_known_size_are_read() {
    let folder = scratch_folder("read");
    let said = |path: &Path| read_file(path, 8).unwrap_err().to_string();
    assert!(said(Path::new("/dev/zero")).contains("a device, and only regular files"));
    let pipe = folder.join("pipe");
    assert!(
        std::process::Command::new("mkfifo")
            .arg(&pipe)
            .status()
            .unwrap()
            .success()
    );
    assert!(said(&pipe).contains("a pipe, and only regular files"));
    assert!(said(&folder).contains("directory"));
    fs::write(folder.join("file"), "123456789").unwrap();
    assert!(said(&folder.join("file")).contains("it has 9 bytes, and at most 8 are read"));
    fs::write(folder.join("file"), b"12\xff").unwrap();
    assert_eq!(read_file(&folder.join("file"), 8).unwrap(), b"12\xff");
    let error = read_text(&folder.join("file"), 8).unwrap_err().to_string();
    assert!(error.contains("not UTF-8 from byte 2"), "{error}");
    fs::remove_dir_all(&folder).unwrap();
}
