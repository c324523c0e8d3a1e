use super::*;

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<_> = entries.collect();
    names.sort();
    names
}

#[test]
fn only_dead_folders_with_the_mark_are_removed() {
    let root = tempfile::tempdir().unwrap();
    let put = |folder: &str, files: &[(&str, &[u8])]| {
        let folder = root.path().join(folder);
        fs::create_dir(&folder).unwrap();
        files.iter().for_each(|(name, bytes)| fs::write(folder.join(name), bytes).unwrap());
    };
    put(".lsys-notes", &[("thesis.txt", b"work")]);
    put(".lsys-empty", &[]);
    put(".lsys-lock", &[("lock", b""), ("1", b"")]);
    put(".lsys-copied", &[("lock", MARK), ("1", b"half"), ("thesis.txt", b"work")]);
    put("marked", &[("lock", MARK)]);
    put(".lsys-dead", &[("lock", MARK), ("1", b"half")]);
    let living = Folder::new(root.path()).unwrap();
    let live = living.path.file_name().unwrap().to_str().unwrap().to_owned();
    remove_dead(root.path());
    let mut expected = vec![&live[..], ".lsys-copied", ".lsys-empty", ".lsys-lock", ".lsys-notes", "marked"];
    expected.sort_unstable();
    assert_eq!(names(root.path()), expected);
    assert_eq!(names(&root.path().join(".lsys-copied")), ["1", "lock", "thesis.txt"]);
    remove(&living.path);
    assert!(!living.path.exists());
}

#[test]
fn a_new_file_replaces_none() {
    let root = tempfile::tempdir().unwrap();
    let path = root.path().join("a");
    let pending = |text: &[u8]| Pending::write(&path, |out| out.write_all(text)).unwrap();
    let (first, second) = (pending(b"1"), pending(b"2"));
    first.commit_new().unwrap();
    assert_eq!(second.commit_new().unwrap_err().kind(), io::ErrorKind::AlreadyExists);
    assert_eq!(fs::read(&path).unwrap(), b"1");
    pending(b"3").commit().unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"3");
}

#[test]
#[cfg(target_os = "linux")]
fn nobody_takes_a_turn_at_a_file_that_goes_back() {
    let root = tempfile::tempdir().unwrap();
    let [path, new] = ["a", "new"].map(|name| root.path().join(name));
    fs::write(&path, "old").unwrap();
    let pending = Pending::write(&path, |out| out.write_all(b"own")).unwrap();
    let looks = std::cell::Cell::new(0);
    let is_known = |file: &Path| {
        looks.set(looks.get() + 1);
        if looks.get() == 1 {
            // An editor saves in the instant after this look.
            fs::write(&new, "edited").unwrap();
            fs::rename(&new, &path).unwrap();
            return true;
        }
        assert_eq!(fs::read(&path).unwrap(), b"own");
        assert!(matches!(File::open(&path).unwrap().try_lock(), Err(TryLockError::WouldBlock)));
        fs::read(file).unwrap() == b"old"
    };
    assert!(!pending.replace(is_known).unwrap());
    assert_eq!((fs::read(&path).unwrap(), looks.get()), (b"edited".to_vec(), 2));
}
