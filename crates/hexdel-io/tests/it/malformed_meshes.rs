//! Every way a file of a mesh can be wrong is a typed error, with its line where the
//! format has lines. OBJ, OFF and Medit's format are tested beside their readers.

use hexdel_io::{MeshFormat, ReadError, read_mesh_from, read_mesh_pair};

fn error(format: MeshFormat, text: &str) -> ReadError {
    match read_mesh_from(text.as_bytes(), format, "f") {
        Err(error) => error,
        Ok(data) => panic!("{text:?} was read as {data:?}"),
    }
}

#[test]
fn msh_of_both_versions() {
    let v4 = |rest: &str| format!("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n{rest}");
    let v2 = |rest: &str| format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{rest}");
    let nodes = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";
    for (text, message) in [
        ("4.1 0 8".to_owned(), "f:1: expected a section, \"$..\", found \"4.1 0 8\""),
        ("$Nodes\n0\n".to_owned(), "f:1: expected $MeshFormat as the first section, found \"$Nodes\""),
        ("$MeshFormat\n4 0 8\n".to_owned(), "f:2: version 4 of the format cannot be read"),
        ("$MeshFormat\n4.1 1 8\n".to_owned(), "f:2: the binary variant of the format cannot be read"),
        ("$MeshFormat\n4.1 0 8\n$End".to_owned(), "f:3: expected the end of the section, found \"$End\""),
        (v4("$Comments\na\n"), "f:5: expected the end of the section, found the end of the file"),
        (v4("$Nodes\n1 1000000000000 1 1\n"), "f:5: more than 4294967295 nodes"),
        (v4("$Nodes\n1 4000000000 1 1\n2 1 0 4000000000\n1\n"), "f:7: file ends after 1 of 4000000000 nodes"),
        (
            v4("$Nodes\n9000000000000000000 1 1 1\n"),
            "f:5: file ends after 0 of 9000000000000000000 blocks of nodes",
        ),
        (v4("$Nodes\n1 1 1 1\n2 1 0 2\n"), "f:6: more than 1 announced nodes"),
        (v4("$Nodes\n1 2 1 2\n2 1 0 1\n1\n0 0 0\n$EndNodes\n"), "f:8: 1 nodes instead of 2"),
        (
            v4("$Nodes\n1 2 1 2\n2 1 0 2\n7 7\n"),
            "f:7: expected a node number that is not in use, found \"7\"",
        ),
        (
            v4("$Nodes\n1 1 1 1\n2 1 0 1\n1\n0 0 1\n"),
            "f:8: expected the z coordinate 0 of a plane mesh, found \"1\"",
        ),
        (v4("$Nodes\n1 1 1 1\n2 1 0 1\n5\n0 1e999 0\n"), "f:8: coordinate 1e999 of point 5 is not finite"),
        (
            v4("$Entities\n0 0 1 0\n1 0 0 0 1 1 0 99999999999 1\n"),
            "f:6: expected the number of a group, found the end of the file",
        ),
        (v4("$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n"), "f:7: an element of type 4 cannot be read"),
        (
            v2(&format!("{nodes}$Elements\n1\n1 2 2 0 1 1 2 4\n")),
            "f:12: expected the number of an existing node, found \"4\"",
        ),
        (
            v2(&format!("{nodes}$Elements\n2\n1 2 2 0 1 9 2 4\n1 2 2 0 1 1 x 5\n$EndElements\n")),
            "f:12: expected the number of an existing node, found \"9\"\n\
             f:12: expected the number of an existing node, found \"4\"\n\
             f:13: expected the number of a node, found \"x\"\n\
             f:13: expected the number of an existing node, found \"5\"",
        ),
        (
            v2("$Nodes\n3\n1 0 z 0\n2 1 0 1\n3 0 y 0\n$EndNodes\n$Elements\nx"),
            "f:6: expected the y coordinate, found \"z\"\n\
             f:7: expected the z coordinate 0 of a plane mesh, found \"1\"\n\
             f:8: expected the y coordinate, found \"y\"",
        ),
        (
            v2(&format!("{nodes}$Elements\n1\n1 2 2 0 1 1 2\n$EndElements")),
            "f:13: expected the number of a node, found \"$EndElements\"",
        ),
        (
            v2(&format!("{nodes}$Elements\n2\n1 2 0 1 2 3\n$EndElements\n")),
            "f:13: expected the number of an element, found \"$EndElements\"",
        ),
        (
            v2(&format!("{nodes}$NodeData\n1\n\"marker\"\n0\n3\n0\n1\n1\n1 0.5\n$EndNodeData\n")),
            "f: the marker 0.5 cannot be read",
        ),
        (v2("$NodeData\n1000000000000\n\"a\"\n"), "f:6: file ends after 0 of 1000000000000 names"),
        (
            v2("$NodeData\n1\n\"marker\"\n0\n3\n0\n1\n1000000000000\n1 1\n"),
            "f:12: file ends after 1 of 1000000000000 data",
        ),
    ] {
        assert_eq!(error(MeshFormat::Msh41, &text).to_string(), message, "{text}");
    }
}

/// A grid of three points and one cell with parts exchanged.
fn vtu(exchange: &[(&str, &str)]) -> String {
    let mut text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\">\n<UnstructuredGrid>\n<Piece>\n\
        <Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points>\n\
        <Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\">0 1 2</DataArray>\n\
        <DataArray type=\"Int32\" Name=\"offsets\">3</DataArray>\n\
        <DataArray type=\"UInt8\" Name=\"types\">5</DataArray>\n</Cells></Piece></UnstructuredGrid></VTKFile>\n"
        .to_owned();
    for (from, to) in exchange {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    text
}

#[test]
fn vtu_of_all_sorts() {
    assert_eq!(read_mesh_from(vtu(&[]).as_bytes(), MeshFormat::Vtu, "f").unwrap().mesh.triangles.len(), 1);
    for (exchange, message) in [
        (
            ("<VTKFile type=\"UnstructuredGrid\"", "<VTKFile type=\"PolyData\""),
            "f:2: expected an UnstructuredGrid, found \"PolyData\"",
        ),
        (
            ("UnstructuredGrid\">", "UnstructuredGrid\" header_type=\"UInt16\">"),
            "f:2: unknown header type \"UInt16\"",
        ),
        (
            ("UnstructuredGrid\">", "UnstructuredGrid\" compressor=\"vtkLZMADataCompressor\">"),
            "f:2: compressor \"vtkLZMADataCompressor\" is not known here, zlib is",
        ),
        (("format=\"ascii\"", "format=\"hex\""), "f:5: unknown format \"hex\" of an array"),
        (("NumberOfComponents=\"3\"", "NumberOfComponents=\"2\""), "f:5: expected points of 3 components"),
        (("0 0 0 1 0 0 0 1 0", "0 0 0 1 0 0 0 one 0"), "f:5: expected a number, found \"one\""),
        (
            ("0 0 0 1 0 0 0 1 0", "0 0 0 1 0"),
            "f:11: the number of coordinates must be a multiple of 3, got 5",
        ),
        (
            ("0 0 0 1 0 0 0 1 0", "0 0 0 1 0 0 0 1 4"),
            "f:11: point 2 at z = 4, out of the plane, cannot be read",
        ),
        (("0 0 0 1 0 0 0 1 0", "0 0 0 1 0 0 0 nan 0"), "f:11: coordinate NaN of point 2 is not finite"),
        (("0 1 2<", "0 1 3<"), "f:11: no point 3, there are 3 counted from 0"),
        (("0 1 2<", "0 1 0.5<"), "f:11: expected the index of a point, found 0.5"),
        ((">3<", ">4<"), "f:11: cell 0 ends at 4 of 3 corners"),
        ((">3<", ">-1<"), "f:11: cell 0 ends at -1 of 3 corners"),
        ((">3<", "><"), "f:11: 0 offsets instead of 1"),
        ((">5<", ">9<"), "f:11: a cell of type 9 with 3 corners cannot be read"),
        (
            ("</Cells>", "<DataArray type=\"Int32\" Name=\"offsets\">3</DataArray></Cells>"),
            "f:10: the Piece has this array twice",
        ),
        (("</Cells></Piece>", "</Piece>"), "f:10: ill-formed document"),
        (("</VTKFile>\n", ""), "f:10: the file ends within a tag"),
    ] {
        let found = error(MeshFormat::Vtu, &vtu(&[exchange])).to_string();
        assert!(found.starts_with(message), "{found}\n{message}");
    }
    let noted =
        "1 0 <InformationKey name=\"RANGE\"><Value index=\"0\">7</Value></InformationKey><Note/></DataArray>";
    let noted = vtu(&[("1 0</DataArray>", noted)]);
    assert_eq!(read_mesh_from(noted.as_bytes(), MeshFormat::Vtu, "f").unwrap().mesh.vertices.len(), 3);
    for text in ["", "no XML", "<a/>", "<VTKFile type=\"UnstructuredGrid\"/>"] {
        let found = read_mesh_from(text.as_bytes(), MeshFormat::Vtu, "f");
        assert_eq!(found.is_ok(), text.starts_with("<VTK"), "{text}");
    }
}

#[test]
fn vtu_whose_binary_arrays_lie() {
    let binary = |text: &str| {
        let (from, to) = ("format=\"ascii\">0 0 0 1 0 0 0 1 0", format!("format=\"binary\">{text}"));
        error(MeshFormat::Vtu, &vtu(&[(from, &to)])).to_string()
    };
    assert_eq!(binary("/////w=="), "f:11: an array is shorter than it says");
    assert_eq!(binary("AAA"), "f:11: base64: Invalid padding");
    assert!(binary("!!!!").starts_with("f:11: "), "{}", binary("!!!!"));
    let appended = |data: &str| {
        let points = ("format=\"ascii\">0 0 0 1 0 0 0 1 0", "format=\"appended\" offset=\"7\">");
        let end = ("</UnstructuredGrid>", format!("</UnstructuredGrid>\n<AppendedData {data}"));
        error(MeshFormat::Vtu, &vtu(&[points, (end.0, &end.1)])).to_string()
    };
    assert_eq!(appended("encoding=\"raw\">_abc"), "f:11: an array is shorter than it says");
    assert_eq!(appended("encoding=\"raw\">abc"), "f:11: appended data do not begin with \"_\"");
    assert_eq!(appended("encoding=\"hex\">_abc"), "f:11: appended data neither raw nor base64");
}

#[test]
fn json_and_ron_of_no_mesh() {
    for (text, message) in [
        ("{\"vertices\": [[0, 0]]}", "f:1:22: missing field `triangles`"),
        (
            "{\"vertices\": [[0, 0]],\n\"triangles\": [[0, 0, 1]]}",
            "f: no point 1, there are 1 counted from 0",
        ),
        (
            "{\"vertices\": [],\n\"triangles\": [[0, 0]]}",
            "f:2:20: invalid length 2, expected an array of length 3",
        ),
        ("{\"vertices\": [[1e400, 0]]}", "f:1:21: number out of range"),
        ("{\"vertices\": [], \"triangles\": [], \"regions\": [1]}", "f: 1 regions instead of 0"),
        (
            "{\"vertices\": [], \"triangles\": [], \"marked_edges\": [{\"ends\": [0, 0], \"marker\": 1}]}",
            "f: no point 0, there are 0",
        ),
    ] {
        let found = error(MeshFormat::Json, text).to_string();
        assert!(found.starts_with(message), "{found}");
    }
    let deep = format!("{{\"a\": {}", "[".repeat(1_000_000));
    assert!(matches!(error(MeshFormat::Json, &deep), ReadError::Json { .. }));
    let ron = "(vertices: [], triangles: [], vertex_markers: Some([1]))";
    assert_eq!(error(MeshFormat::Ron, ron).to_string(), "f: 1 vertex markers instead of 0");
}

/// What a mesh was made to keep is read or refused, in every format that has it.
#[test]
fn promises_that_make_no_sense_are_refused_with_their_line() {
    let ele = |notes: &str| {
        let elements = format!("1 3\n0 0 1 2\n{notes}");
        read_mesh_pair((&b"3 2\n0 0 0\n1 1 0\n2 0 1\n"[..], "n"), (elements.as_bytes(), "f"))
    };
    let head = "# hexdel: angles 30 90 far 43 90 domain inside\n";
    assert_eq!(ele(&format!("{head}# hexdel: exempt 0\n")).unwrap().promised.unwrap().exempt, [0]);
    assert_eq!(ele("# made by hexdel 1.0\n").unwrap().promised, None);
    for (notes, message) in [
        (
            "# hexdel: angles 30\n".to_owned(),
            "f:3: expected hexdel: angles MIN MAX far MIN MAX domain NAME, found \"hexdel: angles 30\"",
        ),
        (
            "# hexdel: exempt 0\n".to_owned(),
            "f:3: expected hexdel: angles MIN MAX far MIN MAX domain NAME, found \"hexdel: exempt 0\"",
        ),
        (
            format!("{head}\n# hexdel: exempt 1\n"),
            "f:5: expected hexdel: exempt and the numbers of triangles, each once, found \"1\"",
        ),
        (
            format!("{head}# hexdel: exempt 0\n# hexdel: exempt 0\n"),
            "f:5: expected hexdel: exempt and the numbers of triangles, each once, found \"0\"",
        ),
    ] {
        assert_eq!(ele(&notes).unwrap_err().to_string(), message);
    }

    let promised = |exempt: &str| {
        format!(
            "{{\"vertices\": [[0, 0], [1, 0], [0, 1]], \"triangles\": [[0, 1, 2]], \"promised\": {{\"near\": \
             {{\"min_deg\": 30, \"max_deg\": 90}}, \"far\": {{\"min_deg\": 43, \"max_deg\": 90}}, \
             \"domain\": \"hull\", \"exempt\": {exempt}}}}}"
        )
    };
    for (exempt, found) in [("[1]", "1"), ("[0, 0]", "0")] {
        let message = format!("f: expected existing triangles as exempt, each once, found {found}");
        assert_eq!(error(MeshFormat::Json, &promised(exempt)).to_string(), message);
    }
    for exempt in ["[-1]", "[0.5]"] {
        assert!(matches!(error(MeshFormat::Json, &promised(exempt)), ReadError::Json { .. }));
    }
}

#[test]
fn promises_of_msh_are_refused_with_their_line() {
    let msh = |names: &str, rows: &str| {
        format!(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{names}$EndPhysicalNames\n$Nodes\n3\n\
             1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n1\n7 2 0 1 2 3\n$EndElements\n{rows}"
        )
    };
    let head = "2 9 \"hexdel: angles 30 90 far 43 90 domain hull\"\n";
    let rows = |rows: &str| {
        let count = rows.lines().count();
        format!("$ElementData\n1\n\"exempt\"\n0\n3\n0\n1\n{count}\n{rows}$EndElementData\n")
    };
    let read = |text: &str| read_mesh_from(text.as_bytes(), MeshFormat::Msh22, "f");
    let data = read(&msh(&format!("1\n{head}"), &rows("7 1\n"))).unwrap();
    assert_eq!(data.promised.unwrap().exempt, [0]);
    assert_eq!(read(&msh("1\n2 9 \"steel\"\n", "")).unwrap().promised, None);
    for (text, message) in [
        (
            msh("1\n2 9 \"hexdel: angles 30 90\"\n", ""),
            "f:6: expected hexdel: angles MIN MAX far MIN MAX domain NAME, found \"hexdel: angles 30 90\"",
        ),
        (
            msh(&format!("2\n{head}{head}"), ""),
            "f:7: expected one name of a group that begins with \"hexdel: \", found \
             \"hexdel: angles 30 90 far 43 90 domain hu..\"",
        ),
        (
            msh(&format!("1\n{head}"), &rows("8 1\n")),
            "f:26: expected 0, or 1 for triangles that are exempt, each once, found 1 for element 8",
        ),
        (
            msh(&format!("1\n{head}"), &rows("7 nan\n")),
            "f:26: expected 0, or 1 for triangles that are exempt, each once, found NaN for element 7",
        ),
        (
            msh(&format!("1\n{head}"), &rows("7 1\n7 1\n")),
            "f:27: expected 0, or 1 for triangles that are exempt, each once, found 1 for element 7",
        ),
        (
            msh(&format!("1\n{head}"), &rows("7 1\n").repeat(2)),
            "f:36: expected one section of element data \"exempt\", found \"1\"",
        ),
    ] {
        assert_eq!(error(MeshFormat::Msh22, &text).to_string(), message, "{text}");
    }
}

#[test]
fn promises_of_vtu_are_refused_with_their_line() {
    let field = |name: &str, values: &str| {
        format!("<DataArray type=\"Float64\" Name=\"hexdel_{name}\" format=\"ascii\">{values}</DataArray>\n")
    };
    let all = |bounds: &str, domain: &str, exempt: &str| {
        let fields = [field("bounds", bounds), field("domain", domain), field("exempt", exempt)].concat();
        format!("<UnstructuredGrid>\n<FieldData>\n{fields}</FieldData>\n")
    };
    let with = |fields: &str| vtu(&[("<UnstructuredGrid>\n", fields)]);
    let read = |fields: &str| read_mesh_from(with(fields).as_bytes(), MeshFormat::Vtu, "f");
    assert_eq!(read(&all("30 90 43 90", "3", "0")).unwrap().promised.unwrap().exempt, [0]);
    let triangles = "numbers of triangles, each once, as hexdel_exempt";
    let none = format!("<FieldData>\n{}</FieldData>\n<UnstructuredGrid>\n", field("exempt", "0"));
    for (fields, message) in [
        (all("30 90 43 90", "3", "-1"), format!("f:7: expected {triangles}, found -1")),
        (all("30 90 43 90", "3", "0.5"), format!("f:7: expected {triangles}, found 0.5")),
        (all("30 90 43 90", "3", "nan"), format!("f:7: expected {triangles}, found NaN")),
        (all("30 90 43 90", "3", "1"), format!("f:7: expected {triangles}, found 1")),
        (all("30 90 43 90", "3", "0 0"), format!("f:7: expected {triangles}, found 0")),
        (
            all("30 90 43", "3", "0"),
            "f:7: expected four bounds of angles as hexdel_bounds, found 30 90 43".to_owned(),
        ),
        (
            all("90 30 43 90", "3", "0"),
            "f:7: expected four bounds of angles as hexdel_bounds, found 90 30 43 90".to_owned(),
        ),
        (
            all("30 90 43 90", "4", "0"),
            "f:7: expected the number of a domain as hexdel_domain, found 4".to_owned(),
        ),
        (all("30 90 43 90", "", "0"), "f:7: expected one number as hexdel_domain, found none".to_owned()),
        (none, "f:4: expected four bounds of angles as hexdel_bounds, found none".to_owned()),
    ] {
        assert_eq!(error(MeshFormat::Vtu, &with(&fields)).to_string(), message, "{fields}");
    }
    let twice = all("30 90 43 90", "3", "0")
        .replace("</FieldData>", &format!("{}</FieldData>", field("domain", "3")));
    assert!(error(MeshFormat::Vtu, &with(&twice)).to_string().contains("has this field data twice"));
}
