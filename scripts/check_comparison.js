// Runs at the end of a page of compare --report, put there by check_report.sh, as check_report.js does for solve.
"use strict";
{
  const lines = [];
  const check = (what, holds) => lines.push((holds ? "holds: " : "FAILS: ") + what);
  const { run, sides: [left, right] } = hemiluxPage;
  const pixels = ({ view }) => {
    view.draw();
    const { gl, canvas } = view, bytes = new Uint8Array(4 * canvas.width * canvas.height);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    return bytes;
  };
  const colours = (bytes) => new Set(new Uint32Array(bytes.buffer)).size;
  const differ = (a, b) => a.some((byte, k) => byte !== b[k]);
  const set = (id, value, event) => {
    document.getElementById(id).value = value;
    document.getElementById(id).dispatchEvent(new Event(event, { bubbles: true }));
  };
  const key = (name) => left.view.canvas.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true, cancelable: true }));
  const text = (id) => document.getElementById(id).textContent;

  const first = pixels(left), truth = pixels(right);
  check("both pictures show many colours", colours(first) > 50 && colours(truth) > 50);
  check("a method and the reference differ", differ(first, truth));
  set("method-left", -1, "change");
  check("the reference is the same on both sides", !differ(pixels(left), pixels(right)));
  set("method-left", 0, "change");
  check("the choice of a method comes back", !differ(first, pixels(left)));

  const slider = document.getElementById("slider");
  const captions = new Set();
  for (let k = 0; k <= Number(slider.max); ++k) {
    set("slider", k, "input");
    captions.add(text("caption-left"));
  }
  check("the slider goes through all steps kept", captions.size === run.methods[0].steps.length);
  check("the slider changes the light", run.methods[0].steps.length < 2 || differ(first, pixels(left)));
  const last = run.rows.filter((row) => row.method === run.methods[0].name && row.run === 0).at(-1);
  check("at its end are the numbers of the last step", text("caption-left").includes(percent(last.true_error)) &&
    text("caption-left").includes(`step ${last.step}:`));
  set("slider", 0, "input");

  set("layer", "difference", "change");
  check("differences of a method have colours, and those of the reference but one besides edges",
    colours(pixels(left)) > 2 * colours(pixels(right)) && !document.getElementById("legend").hidden);
  set("layer", "light", "change");

  key("ArrowLeft");
  check("a key turns both pictures", differ(first, pixels(left)) && differ(truth, pixels(right)));
  key("Home");
  check("Home gives the first view back", !differ(first, pixels(left)) && !differ(truth, pixels(right)));
  key("Enter");
  const chosen = left.view.selected;
  check("a patch is chosen in both pictures", chosen !== null && right.view.selected === chosen);
  check("its table has the light of each method", document.querySelectorAll("#patch tbody tr").length === run.methods.length + 1 &&
    text("patch").includes(number(run.radiosity[3 * chosen])));
  key("Escape");
  check("Escape lets it go", left.view.selected === null && !differ(first, pixels(left)));

  const dots = () => document.querySelectorAll("#chart circle").length;
  const expected = run.rows.filter((row) => row.run === 0 && row.true_error > 0).length;
  check("both panels have a dot for each error of the first run", dots() === 2 * expected || (expected > 100 && dots() > 100));
  check("a dot has the numbers of its row", [...document.querySelectorAll("#chart title")].some((title) =>
    title.textContent.startsWith(`${run.methods[0].label}, step ${last.step}: `)));
  const shown = () => [...document.querySelectorAll("#chart .curve0")].filter((part) => part.style.display !== "none").length;
  const all = shown();
  const box = document.querySelector("#curves input");
  box.click();
  check("a method can be left out of the chart", all > 0 && shown() === 0);
  const kinds = [...document.querySelectorAll("#measure input")];
  kinds.at(-1).click();
  check("another error can be shown, without that method", kinds.length > 1 && shown() === 0 && dots() > 0);
  kinds[0].click();
  box.click();
  check("the method and the error come back", shown() === all && dots() === 2 * expected);
  document.querySelector(`#chart circle.curve0.step${last.step}`).dispatchEvent(new MouseEvent("click"));
  check("a click on a dot shows its step", text("caption-left").includes(`step ${last.step}:`));
  check("the table has a row for each of the CSV", document.querySelectorAll("#steps tbody tr").length === run.rows.length);
  check("nothing is loaded from elsewhere", performance.getEntriesByType("resource").length === 0);
  check("no name has become HTML", document.querySelectorAll("main img, main b, main i").length === 0 && window.hostile === undefined);
  const summary = document.getElementById("summary").parentElement;
  check("a wide window shows all columns of the summary", innerWidth < 1000 || summary.scrollWidth <= summary.clientWidth);
  check("nothing is wider than the window",
    document.documentElement.scrollWidth <= document.documentElement.clientWidth);
  document.body.replaceChildren(element("pre", { id: "check", text: "\n" + lines.join("\n") + "\nall checks ran\n" }));
}
