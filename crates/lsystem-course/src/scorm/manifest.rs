//! The manifest of a package: one organization with one item, which is the page of steps.

use super::{EXERCISE, PAGE, PROGRAM, READ_ME, ScormStandard, escaped};

/// The name that both standards demand, at the root of the zip.
pub(super) const NAME: &str = "imsmanifest.xml";

/// The differences between the standards.
struct Words {
    /// The namespaces and the places of their schemas.
    head: &'static str,
    version: &'static str,
    /// The attribute that makes a resource one that talks to the learning system.
    kind: &'static str,
    /// The end of the item: the page itself tells completion and success.
    sequencing: &'static str,
}

const SCORM12: Words = Words {
    head: "xmlns=\"http://www.imsproject.org/xsd/imscp_rootv1p1p2\"\n  \
           xmlns:adlcp=\"http://www.adlnet.org/xsd/adlcp_rootv1p2\"\n  \
           xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\"\n  \
           xsi:schemaLocation=\"http://www.imsproject.org/xsd/imscp_rootv1p1p2 imscp_rootv1p1p2.xsd \
           http://www.adlnet.org/xsd/adlcp_rootv1p2 adlcp_rootv1p2.xsd\"",
    version: "1.2",
    kind: "scormtype",
    sequencing: "",
};

const SCORM2004: Words = Words {
    head: "xmlns=\"http://www.imsglobal.org/xsd/imscp_v1p1\"\n  \
           xmlns:adlcp=\"http://www.adlnet.org/xsd/adlcp_v1p3\"\n  \
           xmlns:imsss=\"http://www.imsglobal.org/xsd/imsss\"\n  \
           xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\"\n  \
           xsi:schemaLocation=\"http://www.imsglobal.org/xsd/imscp_v1p1 imscp_v1p1.xsd \
           http://www.adlnet.org/xsd/adlcp_v1p3 adlcp_v1p3.xsd \
           http://www.imsglobal.org/xsd/imsss imsss_v1p0.xsd\"",
    version: "2004 3rd Edition",
    kind: "scormType",
    sequencing: "\n        <imsss:sequencing><imsss:deliveryControls completionSetByContent=\"true\" \
                 objectiveSetByContent=\"true\"/></imsss:sequencing>",
};

/// The manifest of a package with this name, and with the page of programs if it has that.
pub(super) fn manifest(standard: ScormStandard, id: &str, title: &str, has_programs: bool) -> String {
    let program = if has_programs { format!("\n      <file href=\"{PROGRAM}\"/>") } else { String::new() };
    let Words { head, version, kind, sequencing } = match standard {
        ScormStandard::Scorm12 => SCORM12,
        ScormStandard::Scorm2004 => SCORM2004,
    };
    let title = escaped(title);
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>
<manifest identifier=\"l-system-{id}\" version=\"1.0\"
  {head}>
  <metadata>
    <schema>ADL SCORM</schema>
    <schemaversion>{version}</schemaversion>
  </metadata>
  <organizations default=\"steps\">
    <organization identifier=\"steps\">
      <title>{title}</title>
      <item identifier=\"item\" identifierref=\"page\" isvisible=\"true\">
        <title>{title}</title>{sequencing}
      </item>
    </organization>
  </organizations>
  <resources>
    <resource identifier=\"page\" type=\"webcontent\" adlcp:{kind}=\"sco\" href=\"{PAGE}\">
      <file href=\"{PAGE}\"/>
      <file href=\"{EXERCISE}\"/>
      <file href=\"{READ_ME}\"/>{program}
    </resource>
  </resources>
</manifest>
"
    )
}
