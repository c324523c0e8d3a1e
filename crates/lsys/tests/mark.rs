//! Answers to an exercise, as `lsys mark` marks them.

use crate::program;

use expect_test::{Expect, expect};
use lsystem::Definition;
use lsystem::course::{Exercise, Given};
use program::{command, printed};

fn koch() -> Exercise {
    let target = Definition {
        axiom: "F".into(),
        rules: "F -> F+F--F+F".into(),
        angle: 60.0,
        iterations: 3,
        ..Definition::default()
    };
    Exercise { title: "The <first> curve".into(), target, n: Given::Free, ..Exercise::default() }
}

fn escaped(text: &str) -> String {
    text.bytes().map(|byte| format!("%{byte:02X}")).collect()
}

fn answer(exercise: &str, by: &str, rules: &str, n: u32) -> String {
    format!("https://example.org/exercise.html#v=1&x={exercise}&n={n}&rules={}&by={}", escaped(rules), escaped(by))
}

fn told(words: &[&str], expected: &Expect) {
    let folder = tempfile::tempdir().expect("a folder");
    let exercise = koch().write();
    std::fs::write(folder.path().join("exercise.txt"), format!("Here it is: \n#v=1&x={exercise}\n")).expect("written");
    let other = Exercise { title: "Another".into(), ..koch() }.write();
    let rows = [
        answer(&exercise, "Ada", "F -> F+F--F+F", 3),
        format!("Noether, \"\",\"{}\"", answer(&exercise, "", "F -> F-F++F-F", 3)),
        format!("1912;Turing;{}", answer(&exercise, "Ada", "F -> F", 3)),
        answer(&exercise, "=1+1 <b>", "F -> F+F--F+F", 2),
        answer(&exercise, "Emmy", "F -> F(", 3),
        answer(&other, "Mary", "F -> F+F--F+F", 3),
        answer("AAAA", "Grace", "F -> F+F--F+F", 3),
        "a row without a link, and, more".to_owned(),
    ];
    std::fs::write(folder.path().join("answers.csv"), rows.join("\r\n")).expect("written");
    let file = r#"{"name": "own", "initial": "F", "angle_deg": 60, "num_iters": 3, "rules": {"F": "F+F--F+F"}}"#;
    std::fs::write(folder.path().join("own.json"), file).expect("written");
    let (code, text) = printed(&mut command(folder.path(), words));
    let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap_or_default();
    if words.contains(&"--html") {
        assert!(page.contains("<h1>The &lt;first&gt; curve</h1>") && page.contains("=1+1 &lt;b&gt;"), "{page}");
        assert!(page.matches("data:image/png;base64,").count() == 6 && !page.contains("<script"), "{page}");
    }
    expected.assert_eq(&format!("{code:?}\n{text}"));
}

#[test]
fn answers_are_marked() {
    told(
        &["mark", "exercise.txt", "answers.csv", "own.json", "--html", "page.html"],
        &expect![[r#"
            Some(0)
            name            by        solved  agrees  symbols  remark
            answers, row 1  Ada       yes    100.0 %        9  The picture is the same, at every number of iterations.
            Noether                   no       3.7 %        9  3.7 % of the ink agrees. Your drawing is a mirror image: left and right are exchanged.
            1912            Ada       no       1.2 %        2  1.2 % of the ink agrees. All that you draw is right, but 63 segments are missing.
            answers, row 4  =1+1 <b>  no      63.9 %        9  63.9 % of the ink agrees. The same after one more iteration.
            answers, row 5  Emmy      no       0.0 %        1  This `(` is never closed
            answers, row 6  Mary      no                       an answer to another exercise
            answers, row 7  Grace     no                       an answer to another exercise
            own                       yes    100.0 %        9  The picture is the same, at every number of iterations.
            2 of 8 solved.
        "#]],
    );
    let link = answer(&koch().write(), "Ada, at home", "F -> F+F--F+F", 3);
    told(
        &["mark", &link, &link, "--csv"],
        &expect![[r#"
            Some(0)
            name,by,solved,agreement_percent,symbols,target_segments,own_segments,remark,link
            link,"Ada, at home",yes,100.0,9,64,64,"The picture is the same, at every number of iterations.",https://example.org/exercise.html#v=1&x=eNpNj81Og0AAhGFLysJCgUBYu_wYbWpsjDGe9GBCCi3Q7gLVblPrptTE6LGv4KtLL6bHLzOZL_NEiekAmGXFTcmHejsOIlvUAw-5GERBuksAaws2zRwj5GlgfDlzZiuhrphFKdz3-nWkdPltUwmsMr70wPGhXoj6bpmUhx_y63lHicjYGkIfyQDpF_CTWjo4-dbpQJ4Rcu-oCLJtppvR9hB0rGpQOuNryvNeCBWxWPEZTfmkY78PfFy0IGMf-4Ty5DltVBvL3O1V_3td_222WdPjmuULZlixhgHSTn4pP7R2JRSZdn_Ii2TadgizTXHZpNX39ArJ0Gdby9Biw612fBJYeh81Atsxi4L5ahRHYxQRBRVlvtrM949_Q0M5og&n=3&rules=%46%20%2D%3E%20%46%2B%46%2D%2D%46%2B%46&by=%41%64%61%2C%20%61%74%20%68%6F%6D%65
        "#]],
    );
    told(
        &["mark", "own.json", "answers.csv"],
        &expect![[r#"
        Some(1)
        error: own.json: there is no link of an exercise (with x=...)
    "#]],
    );
    told(
        &["mark", "#x=AAAA", "answers.csv"],
        &expect![[r#"
        Some(1)
        error: the exercise is damaged or cut off
    "#]],
    );
    told(
        &["mark", "exercise.txt", "missing.csv"],
        &expect![[r#"
        Some(1)
        error: missing.csv: No such file or directory (os error 2)
    "#]],
    );
}
