//! SVG pictures of other programs, drawn as levels of grey.

use lsystem_svg::{SvgPicture, draw_svg, is_svg};
use std::f64::consts::PI;

/// The most units of a picture.
const MAX: u64 = 500_000_000;

/// A picture of 200 times 100, drawn with 1024 times 512 pixels.
fn picture(inside: &str) -> String {
    format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 200 100">{inside}</svg>"#
    )
}

fn drawn(inside: &str) -> SvgPicture {
    draw_svg(picture(inside).as_bytes()).unwrap_or_else(|why| panic!("{why}: {inside}"))
}

/// The ink in square units of the picture: the area of what is black.
fn ink(svg: &SvgPicture) -> f64 {
    let sum: u64 = svg.grey.iter().map(|&level| u64::from(255 - level)).sum();
    sum as f64 / 255.0 / (1024.0 * 1024.0) * 40_000.0
}

#[track_caller]
fn has_ink(inside: &str, area: f64) {
    let found = ink(&drawn(inside));
    assert!((found - area).abs() < 0.5 + 0.004 * area, "{found} instead of {area}: {inside}");
}

#[track_caller]
fn refused(text: &str, words: &str) {
    match draw_svg(text.as_bytes()) {
        Err(why) => assert!(why.message.contains(words), "{why}"),
        Ok(svg) => panic!("drawn with {} units instead of: {words}", svg.work),
    }
}

#[test]
fn shapes_cover_their_area() {
    for (inside, area) in [
        (r#"<rect x="10" y="10" width="50" height="20"/>"#, 1000.0),
        (r#"<rect x="10" y="10" width="50" height="20" rx="10"/>"#, 1000.0 - (4.0 - PI) * 100.0),
        (r#"<rect x="10" y="10" width="50" height="20" ry="4" rx="100"/>"#, 1000.0 - (4.0 - PI) * 25.0 * 4.0),
        (r#"<circle cx="100" cy="50" r="40"/>"#, PI * 1600.0),
        (r#"<circle cx="50%" cy="50%" r="10"/>"#, PI * 100.0),
        (r#"<ellipse cx="100" cy="50" rx="40" ry="20"/>"#, PI * 800.0),
        (r#"<polygon points="10,10 110,10 110,90"/>"#, 4000.0),
        (r#"<polyline points="10,10 110,10 110,90"/>"#, 4000.0),
        (r#"<line x1="10" y1="10" x2="110" y2="10" stroke="black" stroke-width="4"/>"#, 400.0),
        (r#"<path d="M10 10H110V90Z"/>"#, 4000.0),
        (r#"<path d="m10,10h100v80z m100 0l10 0 0 10z"/>"#, 4050.0),
        (r#"<path d="M10 50C10 0 110 0 110 50"/>"#, 3000.0),
        (r#"<path d="M10 50C10 25 35 12.5 60 12.5S110 25 110 50"/>"#, 3000.0),
        (r#"<path d="M10 50Q60 0 110 50"/>"#, 2.0 / 3.0 * 100.0 * 25.0),
        (r#"<path d="M10 50Q35 0 60 50T110 50"/>"#, 2.0 * 2.0 / 3.0 * 50.0 * 25.0),
        (r#"<path d="M60 50A50 30 0 0 1 160 50"/>"#, PI * 750.0),
        (r#"<path d="M60 50a50 30 90 1 1 60 0"/>"#, PI * 750.0),
        (r#"<path d="M60 50a1 1 0 0 0 60 0"/>"#, PI * 450.0),
        (r#"<path d="M50 10h40v40h-40z M60 20h20v20h-20z"/>"#, 1600.0),
        (r#"<path fill-rule="evenodd" d="M50 10h40v40h-40z M60 20h20v20h-20z"/>"#, 1200.0),
        (r#"<path d="M50 10h40v40h-40z M60 20v20h20v-20z"/>"#, 1200.0),
    ] {
        has_ink(inside, area);
    }
}

#[test]
fn lines_have_their_width_caps_joins_and_dashes() {
    let line = |more: &str| format!(r#"<path d="M50 50h100" stroke="black" stroke-width="10" {more}/>"#);
    let bend = |more: &str| format!(r#"<path d="M50 80v-50h50" fill="none" stroke="black" stroke-width="20" {more}/>"#);
    let acute =
        |more: &str| format!(r#"<path d="M50 80l5 -50l5 50" fill="none" stroke="black" stroke-width="4" {more}/>"#);
    for (inside, area) in [
        (line(""), 1000.0),
        (line(r#"stroke-linecap="round""#), 1000.0 + PI * 25.0),
        (line(r#"stroke-linecap="square""#), 1100.0),
        (line(r#"stroke-dasharray="10""#), 500.0),
        (line(r#"stroke-dasharray="10 5 5""#), 10.0 * (10.0 + 5.0 + 5.0 + 10.0 + 5.0 + 5.0 + 10.0 + 5.0)),
        (line(r#"stroke-dasharray="30 10" stroke-dashoffset="-5""#), 10.0 * (30.0 + 30.0 + 15.0)),
        (line(r#"stroke-dasharray="0 25" stroke-linecap="round""#), 4.0 * PI * 25.0),
        (line(r#"stroke-dasharray="0""#), 1000.0),
        (line(r#"stroke-dasharray="-3 4""#), 1000.0),
        (r#"<path d="M50 50h0" stroke="black" stroke-width="10" stroke-linecap="round"/>"#.to_owned(), PI * 25.0),
        (r#"<path d="M50 50h0" stroke="black" stroke-width="10" stroke-linecap="square"/>"#.to_owned(), 100.0),
        (bend(""), 2000.0),
        (bend(r#"stroke-linejoin="bevel""#), 1950.0),
        (bend(r#"stroke-linejoin="round""#), 1900.0 + PI * 25.0),
        (bend(r#"stroke-miterlimit="1""#), 1950.0),
        (
            r#"<rect x="50" y="20" width="60" height="60" fill="none" stroke="black" stroke-width="10"/>"#.to_owned(),
            2400.0,
        ),
        (r#"<g transform="scale(2 1)"><path d="M50 10v50" stroke="black" stroke-width="5"/></g>"#.to_owned(), 500.0),
        // Thin lines are one pixel wide.
        (r#"<path d="M50 50h100" stroke="black" stroke-width=".0001"/>"#.to_owned(), 100.0 * 200.0 / 1024.0),
    ] {
        has_ink(&inside, area);
    }
    assert!(ink(&drawn(&acute(r#"stroke-miterlimit="30""#))) > ink(&drawn(&acute(""))) + 15.0);
}

#[test]
fn groups_references_and_nested_pictures_are_placed() {
    for (inside, area) in [
        (r#"<g transform="translate(20 20) rotate(30) scale(2)"><rect width="10" height="20"/></g>"#, 800.0),
        (r#"<g transform="matrix(1 0 .5 1 20 20) skewX(10)"><rect width="20" height="20"/></g>"#, 400.0),
        (
            r##"<defs><rect id="r" width="10" height="10"/></defs><use href="#r" x="20" y="20"/><use xlink:href="#r" transform="translate(50 50) scale(3)"/>"##,
            1000.0,
        ),
        (
            r##"<symbol id="s" viewBox="0 0 10 10"><rect width="10" height="10"/></symbol><use href="#s" x="50" y="10" width="80" height="40"/>"##,
            1600.0,
        ),
        (
            r#"<svg x="10" y="10" width="80" height="40" viewBox="0 0 10 10"><rect width="10" height="10"/></svg>"#,
            1600.0,
        ),
        (
            r#"<svg x="10" y="10" width="80" height="40" viewBox="0 0 10 10" preserveAspectRatio="none"><rect width="10" height="10"/></svg>"#,
            3200.0,
        ),
        (
            r#"<svg x="10" y="40" width="20" height="10" viewBox="0 0 10 10" preserveAspectRatio="xMinYMax slice"><rect width="10" height="10"/></svg>"#,
            400.0,
        ),
        (
            r#"<switch><foreignObject/><g requiredExtensions="x"><rect width="99" height="99"/></g><rect width="10" height="10"/><rect width="50" height="50"/></switch>"#,
            100.0,
        ),
        (r##"<g id="a"><a><rect width="10" height="10"/></a></g><use href="#a" x="50"/><use href="#none"/>"##, 200.0),
        (
            r#"<rect width="1in" height="10"/><rect y="20" width="25.4mm" height="10"/><rect y="40" width="72pt" height="10"/><rect y="60" width="48%" height="10%"/>"#,
            4.0 * 960.0,
        ),
    ] {
        has_ink(inside, area);
    }
}

#[test]
fn styles_are_inherited_and_the_strongest_wins() {
    let square = r#"width="20" height="20""#;
    for (inside, area) in [
        (format!(r#"<g fill="white"><rect {square}/><rect {square} fill="black" x="50"/></g>"#), 400.0),
        (format!(r#"<g fill="white"><rect {square} style="fill: #000 !important; x: 3"/></g>"#), 400.0),
        (
            format!(r#"<rect {square} opacity=".5"/><g opacity="50%"><rect {square} x="50" fill-opacity=".5"/></g>"#),
            300.0,
        ),
        (format!(r#"<rect {square} fill="rgba(0,0,0,.25)"/><rect {square} x="50" fill="rgb(50%,50%,50%)"/>"#), 300.0),
        (
            format!(r#"<g color="black" fill="currentColor"><rect {square}/></g><rect {square} x="50" fill="none"/>"#),
            400.0,
        ),
        (
            format!(
                r#"<g display="none"><rect {square}/></g><g visibility="hidden"><rect {square}/><rect {square} visibility="visible"/></g>"#
            ),
            400.0,
        ),
        (
            format!(
                r#"<style>/* {{ */ .a,.b{{fill:black}} rect{{fill:white}} #i{{fill:white}} *{{fill:none}}</style><rect class="c b" {square}/><rect class="a" id="i" {square} x="50"/><rect {square} x="100"/>"#
            ),
            400.0,
        ),
        (
            format!(
                r#"<style><![CDATA[@import url(x); @media print {{ rect {{ fill: white }} }} rect.t {{ fill:black }}]]></style><rect fill="white" class="t" {square}/>"#
            ),
            400.0,
        ),
        (
            format!(
                r##"<linearGradient id="b"><stop stop-color="#000" stop-opacity=".5"/><stop stop-color="white"/></linearGradient><radialGradient id="a" xlink:href="#b"/><rect {square} fill="url(#a)"/><rect {square} x="50" fill="url(#x) black"/><rect {square} x="90" fill="url(#x)"/>"##
            ),
            600.0,
        ),
        (
            format!(
                r#"<rect {square} fill="hsl(0,0%,0%)"/><rect {square} x="50" fill="Black"/><rect {square} x="90" fill="nonsense"/>"#
            ),
            1200.0,
        ),
    ] {
        has_ink(&inside, area);
    }
}

#[test]
fn pages_have_the_shape_of_the_file() {
    let head = r#"<svg xmlns="http://www.w3.org/2000/svg""#;
    let body = r#"><path d="M0 0H9V9z"/></svg>"#;
    for (size, expected) in [
        (r#"viewBox="0 0 200 100" width="100%""#, [1024, 512]),
        (r#"width='30mm' height="60mm""#, [512, 1024]),
        (r#"viewBox="0 0 0 9""#, [1024, 1024]),
        (r#"viewBox="0 0 1 1e9""#, [1024, 1024]),
        ("", [1024, 1024]),
    ] {
        let svg = draw_svg(format!("{head} {size}{body}").as_bytes()).expect("a picture");
        assert_eq!([svg.width, svg.height], expected, "{size}");
    }
    // White on nothing is seen on black.
    assert_eq!(drawn(r#"<rect x="50" width="10" height="10" fill="white"/>"#).grey[0], 0);
}

#[test]
fn files_of_other_programs_are_read() {
    let illustrator = r##"<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd" [
	<!ENTITY ns_svg "http://www.w3.org/2000/svg"> <!ENTITY dark "#000"> ]>
<svg xmlns="&ns_svg;" x="0px" viewBox="0 0 200 100" style="enable-background:new 0 0 9 9;" xml:space="preserve">
<style type="text/css"> .st0{fill:none;stroke:&dark;;stroke-width:4;} .st1{fill:none;stroke:#000000;stroke-width:4;}</style>
<switch><g><line class="st1" x1="50" y1="10" x2="50" y2="60"/><rect fill="&dark;" width="10" height="10"/></g></switch></svg>"##;
    let inkscape = r#"<svg:svg xmlns:svg="http://www.w3.org/2000/svg" xmlns:sodipodi="x" viewBox="0 0 200 100"><sodipodi:namedview>
<sodipodi:path d="M0 0h200v100z"/></sodipodi:namedview><svg:g><svg:path sodipodi:d="M0 0h200v100z" d="M10 10h30v10h-30z"/></svg:g></svg:svg>"#;
    for text in [illustrator, inkscape] {
        assert!(is_svg(text.as_bytes()));
        let found = ink(&draw_svg(text.as_bytes()).expect("a picture"));
        assert!((found - 300.0).abs() < 2.0, "{found}");
        let mut wide = vec![0xff, 0xfe];
        text.encode_utf16().for_each(|unit| wide.extend(unit.to_le_bytes()));
        assert!(is_svg(&wide));
        assert_eq!(draw_svg(&wide), draw_svg(format!("\u{feff}{text}").as_bytes()));
    }
    assert!(!is_svg(b"FF<F>F") && !is_svg(b"F -> svg") && !is_svg(b""));
}

#[test]
fn what_is_left_out_is_named() {
    let svg = drawn(
        r#"<script>alert(1)</script><rect width="9" height="9" clip-path="url(#c)" style="mask:url(#m);filter:blur(9px)" marker-end="url(#x)"/>
        <text>a</text><image href="a.png"/><defs><text>b</text></defs><use href="other.svg#a"/><rect fill="url(#p)"/><pattern id="p"/>"#,
    );
    assert_eq!(
        svg.left_out,
        ["clip paths", "markers", "masks", "filters", "text", "images", "other files", "patterns"]
    );
    refused(&picture("<text>F</text>"), "Left out: text");
    refused(&picture(""), "one shade of grey");
    assert!(drawn(r#"<rect width="9" height="9" clip-path="none"/><text display="none"/>"#).left_out.is_empty());
}

#[test]
fn damaged_files_are_refused() {
    for text in
        ["", "<html></html>", "<svg>", "<svg/><svg/>", "</svg>", "<!DOCTYPE svg [", "<svg a='", "<svg></g></svg>"]
    {
        refused(text, "damaged");
    }
    for inside in ["<!--", "</svg></svg>", "<![CDATA[", "<g", "<path d=/>", "<a \""] {
        refused(&picture(&inside.repeat(2)), "damaged");
    }
    refused(&" ".repeat((16 << 20) + 1), "16 MB");
    // A path is drawn up to its first mistake.
    has_ink(r#"<path d="M10 10h20v20h-20z L 3 oops"/>"#, 400.0);
    has_ink(r#"<path d="M10 10h20v20h-20z M1e999 4h5"/><rect width="1e999" height="9"/><path d="h5v5z"/>"#, 400.0);
    has_ink(r#"<rect width="10" height="10" transform="scale(1e300)"/><rect width="10" height="10"/>"#, 100.0);
}

/// About a mebibyte of one text.
fn mebibyte(part: &str) -> String {
    part.repeat((1 << 20) / part.len())
}

/// The work of hostile files is bounded, whether they are drawn or refused; the words say what was too much.
#[test]
fn the_work_of_hostile_files_is_bounded() {
    let uses = |count: usize, two: &str| -> String {
        (0..count).map(|at| format!(r##"<g id="g{}">{}</g>"##, at + 1, two.replace('@', &at.to_string()))).collect()
    };
    let twice = r##"<use href="#g@"/><use xlink:href="#g@"/>"##;
    let groups = |attribute: &str| format!("<g {attribute}><path d='M0 0H9V9z'/></g>");
    let far = r#"<path d="M0 0H200V100H0z" stroke="black" stroke-width="99"/>"#;
    let zigzag = format!("M0 0{}", mebibyte("L200 100 0 0"));
    let mut wrong: Vec<String> = Vec::new();
    for (name, inside, words) in [
        (
            "bomb of references",
            format!(r##"<path id="g0" d="M0 0H9"/>{}<use href="#g60"/>"##, uses(60, twice)),
            Some("elements"),
        ),
        ("itself", r##"<g id="a"><path d="M0 0h9"/><use href="#a"/></g>"##.to_owned(), Some("draws itself")),
        ("itself twice", r##"<g id="a"><use href="#a"/><use href="#a"/></g>"##.to_owned(), Some("draws itself")),
        (
            "each other",
            r##"<g id="a"><use href="#b"/></g><g id="b"><use href="#a"/></g>"##.to_owned(),
            Some("draws itself"),
        ),
        ("depth", "<g>".repeat(2000) + &"</g>".repeat(2000), Some("levels")),
        ("elements", mebibyte("<g/>"), Some("one shade")),
        ("unknown elements", mebibyte("<i/>"), Some("one shade")),
        ("blurred groups", mebibyte(&groups(r#"style="filter:blur(40px)""#)), None),
        ("opacity of groups", mebibyte(&groups(r#"opacity=".9""#)), None),
        ("dashes", mebibyte(r#"<path d="M0 0H200" stroke="black" stroke-dasharray=".00001"/>"#), Some("dashes")),
        ("tiny dashes", r#"<path d="M0 0H200" stroke="black" stroke-dasharray="1e-300"/>"#.to_owned(), Some("dashes")),
        ("large pictures", mebibyte(far), Some("pixels")),
        ("wide pens", mebibyte(r#"<path d="M0 0L200 100" stroke="black" stroke-width="150"/>"#), Some("pixels")),
        ("zigzag", format!(r#"<path d="{zigzag}" fill="none" stroke="black"/>"#), Some("pixels")),
        ("filled zigzag", format!(r#"<path d="{zigzag}"/>"#), Some("pixels")),
        (
            "round zigzag",
            format!(r#"<path d="{zigzag}" stroke-width="90" stroke="black" stroke-linejoin="round"/>"#),
            Some(""),
        ),
        ("curves", format!(r#"<path d="M0 0{}"/>"#, mebibyte("c9 9 9-9 0 0")), Some("")),
        ("arcs", format!(r#"<path d="M0 0{}"/>"#, mebibyte("a1e9 1e9 0 1 1 9 9")), Some("")),
        ("lines", mebibyte("<path d='M0 0L9 9' stroke='#000'/>"), None),
        ("points", format!(r#"<polygon points="{}"/>"#, mebibyte("0 0 9 9 ")), Some("")),
        ("attributes", format!("<path {}/>", mebibyte("a='' d='' ")), Some("")),
        (
            "distinct attributes",
            format!("<path {}/>", (0..90_000).map(|at| format!("a{at}='' ")).collect::<String>()),
            Some(""),
        ),
        (
            "namespaces",
            format!(
                "<g {}>{}</g>",
                (0..30_000).map(|at| format!("xmlns:a{at}='b' ")).collect::<String>(),
                "<a1:g/>".repeat(60_000)
            ),
            Some(""),
        ),
        (
            "long path, used often",
            format!(
                r##"<defs><path id="p" d="M0 0{}"/></defs>{}"##,
                "h1".repeat(100_000),
                r##"<use href="#p"/>"##.repeat(10_000)
            ),
            Some("path segments"),
        ),
        (
            "style, used often",
            format!(
                r##"<defs><path id="p" style="{}"/></defs>{}"##,
                "fill:red;".repeat(50_000),
                r##"<use href="#p"/>"##.repeat(10_000)
            ),
            Some("styles"),
        ),
        ("selectors", format!("<style>{}{{}}</style>", mebibyte("a,")), Some("styles")),
        ("rules", format!("<style>{}</style>{}", "g{fill:red}".repeat(40_000), "<g/>".repeat(40_000)), Some("styles")),
        (
            "classes",
            format!("<style>{}</style><g class='{}'/>", ".a{fill:red}".repeat(10_000), "a ".repeat(100_000)),
            Some("styles"),
        ),
        ("a long selector", format!("<style>{}{{}}</style>", mebibyte(".a")), Some("")),
        ("comments of styles", format!("<style>{}</style>", mebibyte("/*")), Some("one shade")),
        ("blocks of styles", format!("<style>{}</style>", mebibyte("@a{")), Some("one shade")),
        ("braces of styles", format!("<style>{}</style>", mebibyte("a{")), Some("")),
        (
            "gradients",
            format!(
                r##"<linearGradient id="g">{}</linearGradient>{}"##,
                "<g/>".repeat(100_000),
                "<path fill='url(#g)'/>".repeat(20_000)
            ),
            Some("elements"),
        ),
        (
            "gradients of gradients",
            format!(r##"<linearGradient id="g" href="#g"/>{}"##, mebibyte("<path fill='url(#g)'/>")),
            Some(""),
        ),
        (
            "nested pictures",
            mebibyte("<svg viewBox='0 0 1e-9 1e-9'><path d='M0 0h1e-9' stroke='#000'/></svg>"),
            Some(""),
        ),
    ] {
        let text = picture(&inside);
        match (draw_svg(text.as_bytes()), words) {
            (Ok(svg), None | Some("")) => assert!(svg.work <= MAX, "{name}: {}", svg.work),
            (Ok(svg), Some(_)) => wrong.push(format!("{name} is drawn with {}", svg.work)),
            (Err(why), words) if words.is_some_and(|words| why.message.contains(words)) => {}
            (Err(why), _) => wrong.push(format!("{name}: {why}")),
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Entities and default attributes hide what a file draws from readers of tags.
#[test]
fn entities_and_declarations_are_bounded() {
    let read = |text: &str| draw_svg(text.as_bytes());
    let default = read(include_str!("hostile/svgatt.svg"));
    assert!(default.as_ref().is_ok_and(|svg| svg.work < 1_000_000) || default.is_err(), "{default:?}");
    let hidden = read(include_str!("hostile/svgentuse2.svg"));
    assert!(hidden.as_ref().is_ok_and(|svg| svg.work < 1_000_000) || hidden.is_err(), "{hidden:?}");
    for declared in ["<!a>", "<!--", "<!ENTITY a \"", "<![", "<?", "<!DOCTYPE svg [", "]"] {
        let text = mebibyte(declared);
        assert!(read(&text).is_err() && read(&format!("<!DOCTYPE svg [{text}]><svg/>")).is_err(), "{declared}");
    }
    let large = format!("<!DOCTYPE svg [<!ENTITY e \"{}\">]>", "F".repeat(1 << 19));
    refused(&format!("{large}<svg><g id=\"{}\"/></svg>", "&e;".repeat(1 << 17)), "entities");
    refused(&format!("{large}<svg>{}</svg>", "<g id='&e;'/>".repeat(1 << 15)), "entities");
    // Entities inside entities, and elements inside entities, stay closed.
    let laughs = r#"<!DOCTYPE svg [<!ENTITY a "ha"><!ENTITY b "&a;&a;"><!ENTITY c '<rect width="9" height="9"/>'>]>"#;
    refused(&format!(r#"{laughs}<svg><g id="&b;"/>&b;&c;</svg>"#), "one shade");
}
