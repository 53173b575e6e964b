// The frame of the lesson: chapters, their controls, the address, keys, exercises and the worksheet.
//
// A chapter is lesson.chapter({...}) in a file of chapters/; README.md of this folder says what it holds.
"use strict";

const lesson = (() => {
  const chapters = [];
  const chapter = (description) => { chapters[description.number] = description; };
  const query = (selector, within = document) => within.querySelector(selector);
  const element = (name, attributes = {}, ...children) => {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes))
      if (key in made && key !== "list" && key !== "form") made[key] = value;
      else made.setAttribute(key, value);
    made.append(...children);
    return made;
  };

  // The address: #NUMBER?name=value&...
  const place = () => {
    const [, name = "", search = ""] = /^#?([^?]*)\??(.*)$/.exec(location.hash);
    return { name: name || "0", values: Object.fromEntries(new URLSearchParams(search)) };
  };
  const typed = (text, like) => typeof like === "number" ? (Number.isFinite(Number(text)) ? Number(text) : like)
    : typeof like === "boolean" ? text === "true" : text;
  const restored = (defaults, values) => Object.fromEntries(Object.entries(defaults).map(([key, value]) =>
    [key, key in values ? typed(values[key], value) : value]));

  // What a chapter's figure works with. `values` are the numbers that it shows, for tests.
  class Figure {
    constructor(parent, chosen, state) {
      Object.assign(this, { chapter: chosen, state, values: {}, views: [], timers: new Set(), isOpen: true });
      this.views_ = element("div", { className: "views" });
      this.controls = element("form", { className: "controls", onsubmit: (event) => event.preventDefault() });
      this.sentence = element("p", { className: "sentence" });
      this.sentence.setAttribute("aria-live", "polite");
      this.numbers = element("table");
      this.details = element("details", { className: "numbers" }, element("summary", {}, "The numbers"), this.numbers);
      parent.replaceChildren(this.views_, this.controls, this.sentence, this.details);
    }
    close() {
      this.isOpen = false;
      clearTimeout(this.addressing);
      this.views.forEach((view) => view.close());
      this.onClose?.();
      this.rooms?.forEach((room) => room.delete());
    }
    // Makes a room that goes with the figure.
    room(scene, maxEdge) {
      const made = new hemilux.Room(scene, maxEdge);
      (this.rooms ??= []).push(made);
      return made;
    }
    view(Kind, options) {
      const box = element("div", { className: "view" });
      this.views_.append(box);
      const made = new Kind(box, options);
      box.classList.toggle("wide", Boolean(options.wide));
      if (options.title) box.prepend(made.title = element("div", { className: "title" }, options.title));
      this.views.push(made);
      if (made.eye && this.state.eye !== undefined) {
        const [yaw, pitch] = String(this.state.eye).split(",").map(Number);
        if (Number.isFinite(yaw) && Number.isFinite(pitch)) Object.assign(made.eye, { yaw, pitch });
        made.onTurn = ({ yaw: y, pitch: p }) => {
          this.views.filter((view) => view.eye && view !== made).forEach((view) => { Object.assign(view.eye, { yaw: y, pitch: p }); view.draw(); });
          this.set({ eye: `${y.toFixed(2)},${p.toFixed(2)}` }, false);
        };
      }
      return made;
    }
    // Sets values of the state; the figure shows them and the address keeps them.
    set(values, show = true) {
      Object.assign(this.state, values);
      const search = new URLSearchParams(Object.entries(this.state).filter(([key, value]) => value !== this.chapter.state[key]));
      // Browsers refuse many changes of the address in a short time.
      clearTimeout(this.addressing);
      this.addressing = setTimeout(() => history.replaceState(null, "", `#${this.chapter.number}${String(search) ? "?" + search : ""}`), 150);
      this.controls.querySelectorAll("[data-key]").forEach((input) => input.show());
      if (show) this.update();
    }
    update() {
      if (!this.isOpen) return;
      this.change?.();
      this.views.forEach((view) => view.draw());
    }
    input(key, name, input, read, write, label = name) {
      input.dataset.key = key;
      input.id = `control-${key}`;
      const shown = element("output", { htmlFor: input.id });
      input.show = () => { write(input, this.state[key]); shown.textContent = input.form_ ? input.form_(this.state[key]) : ""; };
      const changed = () => this.set({ [key]: read(input) });
      input.addEventListener("input", changed);
      const row = element("label", { htmlFor: input.id }, element("span", {}, label), input, shown);
      this.controls.append(row);
      input.show();
      return input;
    }
    slider(key, label, low, high, step, form = figures.format) {
      const input = element("input", { type: "range", min: low, max: high, step });
      input.form_ = form;
      return this.input(key, label, input, (it) => Number(it.value), (it, value) => { it.value = value; });
    }
    choice(key, label, options) {
      const input = element("select", {}, ...Object.entries(options).map(([value, text]) => element("option", { value }, text)));
      return this.input(key, label, input, (it) => typed(it.value, this.chapter.state[key]), (it, value) => { it.value = String(value); });
    }
    toggle(key, label) {
      return this.input(key, label, element("input", { type: "checkbox" }), (it) => it.checked, (it, value) => { it.checked = value; });
    }
    button(label, action, key = "") {
      const made = element("button", { type: "button", onclick: action }, label);
      if (key) { made.setAttribute("aria-keyshortcuts", key); made.dataset.shortcut = key; made.append(element("kbd", {}, key)); }
      this.controls.append(made);
      return made;
    }
    // Offers files, chosen or dropped onto the figure: take({ obj: text, mtl: text }), by the last word of their names.
    files(label, accept, take) {
      const input = element("input", { type: "file", multiple: true, accept });
      const read = async (list) => {
        const texts = await Promise.all([...list].map(async (file) => [file.name.split(".").at(-1).toLowerCase(), await file.text()]));
        if (this.isOpen) take(Object.fromEntries(texts));
      };
      input.onchange = () => read(input.files);
      this.controls.append(element("label", { className: "file" }, element("span", {}, label), input));
      const box = this.controls.parentNode;
      box.ondragover = (event) => { event.preventDefault(); box.classList.add("dropping"); };
      box.ondragleave = () => box.classList.remove("dropping");
      box.ondrop = (event) => {
        event.preventDefault();
        box.classList.remove("dropping");
        read(event.dataTransfer.files);
      };
    }
    say(text) { if (this.sentence.textContent !== text) this.sentence.textContent = text; }
    table(head, rows) {
      this.numbers.replaceChildren(
        element("thead", {}, element("tr", {}, ...head.map((cell) => element("th", { scope: "col" }, String(cell))))),
        element("tbody", {}, ...rows.map(([first, ...rest]) => element("tr", {}, element("th", { scope: "row" }, String(first)),
          ...rest.map((cell) => element("td", {}, typeof cell === "number" ? figures.format(cell) : String(cell)))))));
    }
    // Calls tick(time from 0 to 1) for so many seconds; at once with 1 where motion is not wanted.
    animate(seconds, tick) {
      const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
      this.motion = {};
      const motion = this.motion, begin = performance.now();
      const frame = () => {
        if (!this.isOpen || this.motion !== motion) return;
        const t = still ? 1 : Math.min(1, (performance.now() - begin) / (1000 * seconds));
        tick(t);
        this.views.forEach((view) => view.draw());
        if (t < 1) requestAnimationFrame(frame);
      };
      frame();
    }
    // Calls work() between pictures until it returns false.
    async repeat(work) {
      const turn = this.turn = {};
      for (let isMore = true; isMore && this.isOpen && this.turn === turn;) {
        isMore = work();
        this.views.forEach((view) => view.draw());
        await new Promise((resolve) => setTimeout(resolve, 0));
      }
    }
    stop() { this.turn = null; this.motion = null; }
  }

  const isRight = ({ answer, within = 0.02 }, text) => {
    if (typeof answer !== "number") return text === answer;
    const value = Number(text.replace(",", ".").replace("%", ""));
    return text.trim() !== "" && Math.abs(value - answer) <= Math.abs(within * answer) + 1e-12;
  };
  const exerciseForm = (exercise, number) => {
    const result = element("output", {});
    const input = exercise.choices
      ? element("select", {}, element("option", { value: "" }, "choose"), ...exercise.choices.map((text) => element("option", { value: text }, text)))
      : element("input", { type: "text", inputMode: "decimal", size: 8, autocomplete: "off" });
    input.setAttribute("aria-label", `Answer to exercise ${number}`);
    const form = element("form", { className: "exercise" }, element("p", {}, `${number}. `, exercise.ask), input, element("button", {}, "Check"), result);
    form.onsubmit = (event) => {
      event.preventDefault();
      const right = isRight(exercise, input.value);
      result.textContent = right ? `Right. ${exercise.because ?? ""}` : `Not yet. ${exercise.hint ?? ""}`;
      result.className = right ? "right" : "wrong";
    };
    return form;
  };

  let figure = null, cover = null;
  const main = () => query("main");
  const names = ["The lesson", "worksheet", "plan"];
  const go = (name) => { location.hash = `#${name}`; };

  const showChapter = (chosen, values) => {
    const article = element("article", { className: "text" });
    article.innerHTML = chosen.text;
    const source = element("p", { className: "source" });
    source.innerHTML = `<q>${chosen.source.sentence}</q> <cite>section ${chosen.source.section}</cite><br>Page of source: ` +
      chosen.source.pages.map((page) => `<code>${page}</code>`).join(", ") +
      (chosen.source.measured ? `<br>Measured on other scenes: <code>${chosen.source.measured}</code>` : "");
    const exercises = element("section", { className: "exercises" }, element("h2", {}, "Exercises"),
      ...chosen.exercises.map((exercise, k) => exerciseForm(exercise, k + 1)));
    const box = element("figure", { className: "figure" });
    main().replaceChildren(
      element("header", { className: "head" }, element("span", { className: "number" }, String(chosen.number)), element("h1", {}, chosen.title)),
      box, article, source, exercises);
    const state = restored(chosen.state, values);
    figure = new Figure(box, chosen, state);
    try {
      chosen.figure(figure);
      figure.update();
    } catch (error) {
      figure.say(`The figure cannot be shown: ${error.message}`);
      throw error;
    }
  };

  // The room on the cover, solved while one looks.
  const showCover = (box) => {
    const room = new hemilux.Room(rooms.boxes({ n: 12, reflectance: 0.7 })), view = new figures.RoomView(box, {
      label: "A room with two boxes and a lamp, lit by all bounces of the light", ratio: 1.3, eye: { yaw: 0.1, pitch: 0.08, zoom: 1.06 } });
    const begin = performance.now(), run = room.run("stored-transport", { rays: 64, steps: 1 }).step(), light = run.light;
    view.room = room;
    view.colour = figures.lit(light, figures.exposure(room, light, 0.96));
    view.draw();
    const { rays, error } = run.figures;
    box.parentNode.lastChild.textContent = `${room.patches.length} patches, ${figures.format(rays)} rays, solved in ` +
      `${((performance.now() - begin) / 1000).toFixed(2)} s by stored transport. Its own estimate of the error: ${figures.percent(error)}. Drag to turn.`;
    run.delete();
    cover = { values: { light: [...light], error, rays }, close: () => { view.close(); room.delete(); } };
  };

  const showPage = (name) => {
    const template = query(`template#${name}`);
    main().replaceChildren(template.content.cloneNode(true));
    const live = query(".live", main());
    if (live) showCover(live);
    const list = query(".contents", main());
    if (list) list.append(...chapters.filter(Boolean).map(({ number, title, summary }) =>
      element("li", {}, element("a", { href: `#${number}` }, element("b", {}, title), element("span", {}, summary)))));
    const sheet = query(".questions", main());
    if (sheet) for (const { number, title, exercises } of chapters.filter(Boolean))
      sheet.append(element("h2", {}, `${number}. ${title}`), element("ol", {}, ...exercises.map(({ ask, choices }) =>
        element("li", {}, ask, choices ? element("span", { className: "choices" }, choices.join("  ·  ")) : "", element("div", { className: "answer" })))));
  };

  let shown = "";
  const show = () => {
    const { name, values } = place();
    figure?.close();
    cover?.close();
    figure = cover = null;
    const chosen = chapters[Number(name)];
    const title = chosen ? chosen.title : { worksheet: "Worksheet", plan: "Plan" }[name] ?? "The paper alive";
    document.title = `${title} · hemilux`;
    document.body.dataset.page = chosen ? "chapter" : name;
    if (chosen) showChapter(chosen, values);
    else showPage(["worksheet", "plan"].includes(name) ? name : "start");
    document.querySelectorAll("nav a").forEach((link) => {
      if (link.getAttribute("href") === `#${name}`) {
        link.setAttribute("aria-current", "page");
        link.parentNode.parentNode.scrollLeft = link.offsetLeft - link.parentNode.parentNode.offsetLeft - 60;
      } else link.removeAttribute("aria-current");
    });
    if (name !== shown) { window.scrollTo(0, 0); main().focus({ preventScroll: true }); }
    shown = name;
  };

  const move = (by) => {
    const next = Math.max(0, Number(place().name) + by);
    if (next === 0 || chapters[next]) go(next);
  };
  const present = (on = !document.body.classList.contains("present")) => {
    document.body.classList.toggle("present", on);
    query("#present").setAttribute("aria-pressed", String(on));
    figure?.views.forEach((view) => view.draw());
  };
  const keys = (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || /^(input|select|textarea)$/i.test(event.target.tagName) && event.target.type !== "range") return;
    const actions = { n: () => move(1), PageDown: () => move(1), b: () => move(-1), PageUp: () => move(-1), p: () => present(), Escape: () => present(false) };
    const pressed = document.querySelector(`[data-shortcut="${CSS.escape(event.key)}"]`);
    if (pressed) pressed.click();
    else if (actions[event.key]) actions[event.key]();
    else return;
    event.preventDefault();
  };

  const start = async () => {
    const list = query("nav ol");
    list.append(...chapters.filter(Boolean).map(({ number, title }) =>
      element("li", {}, element("a", { href: `#${number}`, title }, String(number)))));
    query("#present").onclick = () => present();
    query("#next").onclick = () => move(1);
    query("#before").onclick = () => move(-1);
    document.addEventListener("keydown", keys);
    window.addEventListener("hashchange", show);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => figure?.update());
    await hemilux.ready(loadHemilux);
    show();
  };
  return { chapter, start, chapters, isRight, element, get figure() { return figure; }, get cover() { return cover; } };
})();
