// Elements, tables and numbers as text. Names come from files of others, so all text is set as text and never as
// HTML.

const at = (id) => document.getElementById(id);

/** An element with attributes and children; the key `text` is its text. */
function element(name, { text, ...attributes } = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...(text === undefined ? children : [text]));
  return made;
}

const known = (x) => x !== null && x !== undefined && Number.isFinite(x);
const number = (x, digits = 4) => (known(x) ? String(Number(x.toPrecision(digits))) : "unknown");
const percent = (x) => (known(x) ? number(100 * x, 3) + " %" : "unknown");
const grouped = (x) => (known(x) ? Math.round(x).toLocaleString("en").replaceAll(",", "\u202f") : "unknown");
function shortCount(x) {
  for (const [unit, letter] of [[1e12, "T"], [1e9, "G"], [1e6, "M"], [1e3, "k"]])
    if (x >= unit) return number(x / unit, 3) + " " + letter;
  return number(x, 3);
}

/** A table from rows of cells; numbers stand to the right. */
function fillTable(table, heads, rows) {
  const cell = (value, index) =>
    value instanceof Node ? element("td", {}, value)
      : heads ? element("td", known(value) ? { text: value > 9999 ? grouped(value) : String(value), class: "number" } : { text: value ?? "" })
      : element(index === 0 ? "th" : "td", index === 0 ? { text: value, scope: "row" } : { text: value });
  table.replaceChildren();
  if (heads)
    table.append(element("thead", {}, element("tr", {}, ...heads.map((text) => element("th", { text, scope: "col" })))));
  table.append(element("tbody", {}, ...rows.map((row) => element("tr", {}, ...row.map(cell)))));
  return table;
}

/** Three numbers of a colour, on one line where there is room. */
const channels = (light, digits = 4) =>
  element("span", { class: "channels" }, ...light.map((x) => element("span", { text: number(x, digits) })));

/** A colour of light, its numbers after a small square. */
function lightText(light, brightness) {
  if (!light) return "unknown";
  const bytes = light.map((x) => Math.round(255 * clamp((x ?? 0) * brightness, 0, 1) ** (1 / 2.2)));
  const swatch = element("span", { class: "swatch", style: `background: rgb(${bytes})`, "aria-hidden": "true" });
  const text = channels(light);
  text.prepend(swatch);
  return text;
}

function svgElement(name, attributes, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

/** Shows the chart that the program drew; `choose` gets the number of a curve and of the step whose dot was clicked. */
function showChart(chart, choose) {
  if (!chart) return at("chart").replaceChildren(element("p", { class: "hint", text: "No step has a known error." }));
  at("chart").innerHTML = chart.svg; // the program escapes all names in it
  if (!choose) return;
  for (const dot of at("chart").querySelectorAll("circle")) {
    const [curve, step] = [...dot.classList].map((name) => Number(name.replace(/\D+/, "")));
    dot.addEventListener("click", () => choose(curve, step));
  }
}
