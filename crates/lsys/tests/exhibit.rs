//! Exhibitions, as `lsys exhibit` writes them.

use crate::program;

use program::{command, printed};

/// The captions of a page, in order.
fn captions(page: &str) -> Vec<&str> {
    let ends = page.split("<figcaption>").skip(1);
    ends.filter_map(|rest| rest.split_once("</figcaption>").map(|(caption, _)| caption)).collect()
}

#[test]
fn a_folder_becomes_a_page() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("class")).expect("made");
    for (name, title) in [("a", "Fern"), ("b", "<b>Weed</b>"), ("c", "Bush")] {
        let file = format!(
            "{{\"name\": \"{title}\", \"initial\": \"F\", \"num_iters\": 3, \"rules\": {{\"F\": \"F[+F]F\"}}}}"
        );
        std::fs::write(folder.path().join(format!("class/{name}.json")), file).expect("written");
    }
    std::fs::write(folder.path().join("votes.csv"), "name,votes\nc.json,2\na,1\nb,7\n").expect("written");
    let made = |words: &[&str]| {
        let (code, text) =
            printed(&mut command(folder.path(), &[&["exhibit", "class", "--to", "page.html"], words].concat()));
        (code, text, std::fs::read_to_string(folder.path().join("page.html")).expect("a page"))
    };
    let (code, text, page) = made(&[]);
    assert_eq!((code, text.as_str()), (Some(0), "page.html: 3 of 3 drawings\n"));
    assert_eq!(captions(&page), ["1", "2", "3"]);
    assert!(page.matches("data:image/png;base64,iVBOR").count() == 3 && !page.contains("Fern"), "no names");
    let (.., page) = made(&["--names", "--votes", "votes.csv", "--title", "Our <plants>"]);
    assert_eq!(captions(&page), ["&lt;b&gt;Weed&lt;/b&gt;, 7 votes", "Bush, 2 votes", "Fern, 1 vote"]);
    assert!(page.contains("<h1>Our &lt;plants&gt;</h1>") && !page.contains("<script"));
    let orders: std::collections::BTreeSet<_> = (0..8)
        .map(|seed| {
            let (.., page) = made(&["--names", "--seed", &seed.to_string(), "--page", "https://example.org/"]);
            assert!(captions(&page)[0].starts_with("<a href=\"https://example.org/#v=1"), "{:?}", captions(&page));
            captions(&page).join("|")
        })
        .collect();
    assert!(orders.len() > 1, "{orders:?}");
    // The page may lie among the drawings, and is made again.
    for _ in 0..2 {
        let words = ["exhibit", "class", "--to", "class/page.html"];
        let (code, text) = printed(&mut command(folder.path(), words));
        assert_eq!((code, text.as_str()), (Some(0), "class/page.html: 3 of 3 drawings\n"));
    }
    std::fs::remove_file(folder.path().join("class/page.html")).expect("removed");
    std::fs::write(folder.path().join("class/d.json"), "{").expect("written");
    let (code, text, page) = made(&[]);
    assert!(code == Some(1) && text.contains("3 of 4 drawings") && captions(&page).len() == 3, "{text}");
    for (words, told) in [
        (&["exhibit", "votes", "--to", "x.html"][..], "votes"),
        (&["exhibit", "class", "--votes", "class/a.json", "--to", "x.html"], "no votes"),
    ] {
        let (code, text) = printed(&mut command(folder.path(), words));
        assert!(code == Some(1) && text.contains(told), "{text}");
        assert!(!folder.path().join("x.html").exists());
    }
}
