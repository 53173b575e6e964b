// Runs in the lesson's page, put there by scripts/check_lesson.sh: walks through all chapters as a reader would,
// and writes a line for each thing that holds or does not. `expected` has the program's numbers.
"use strict";

(async () => {
  const lines = [];
  const check = (what, holds) => lines.push(`${holds ? "holds: " : "FAILS: "}${what}`);
  const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
  const all = (selector) => [...document.querySelectorAll(selector)];
  const near = (a, b, tolerance) => Math.abs(a - b) <= tolerance * Math.abs(b);
  const same = (a, b) => a.length === b.length && a.every((value, k) => value === b[k]);
  const close = (a, b, tolerance) => {
    const scale = b.reduce((most, value) => Math.max(most, Math.abs(value)), 1e-300);
    return a.length === b.length && a.every((value, k) => Math.abs(value - b[k]) <= tolerance * scale);
  };
  const colours = (canvas) => new Set(new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size;
  // A hash of what a canvas shows, made small.
  const small = Object.assign(document.createElement("canvas"), { width: 160, height: 120 }), pen = small.getContext("2d", { willReadFrequently: true });
  const picture = (canvas) => {
    pen.clearRect(0, 0, small.width, small.height);
    pen.drawImage(canvas, 0, 0, small.width, small.height);
    return new Uint32Array(pen.getImageData(0, 0, small.width, small.height).data.buffer).reduce((hash, word) => (Math.imul(hash, 31) + word) | 0, 7);
  };
  const pictures = () => all(".views canvas").map(picture).join();
  const key = (name, target = document) => target.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true, cancelable: true }));
  const open = async (hash) => {
    location.hash = "#worksheet";
    await wait(60);
    location.hash = hash;
    await wait(60);
    return lesson.figure;
  };
  // A statement of the text of the chapter that is open: it still stands there in these words, and it holds.
  const states = (number, words, holds) => check(`${number}. "${words}"`, holds && document.querySelector("article").textContent.replace(/\s+/g, " ").includes(words));
  const values = () => JSON.stringify(lesson.figure.values);
  // Waits until the figure has done what takes several pictures.
  const settled = async () => { while (lesson.figure?.isBusy) await wait(20); await wait(250); };

  // What is true of each chapter.
  const asChapter = async (chapter) => {
    const { number, title, exercises } = chapter, state = { ...chapter.state, ...chapter.quick }, say = (what, holds) => check(`${number}. ${what}`, holds);
    await open(`#${number}?${new URLSearchParams(chapter.quick ?? {})}`);
    await settled();
    say(`"${title}" is shown`, document.querySelector("h1")?.textContent === title && document.title.startsWith(title));
    const words = document.querySelector("article").textContent.trim().split(/\s+/).length;
    say(`its text has ${words} words, at most 250`, words <= 250);
    say("every canvas is drawn and has a text", all(".views canvas").length > 0 && all(".views canvas").every((canvas) => colours(canvas) > 8 && canvas.getAttribute("aria-label")));
    const inside = (view) => view.room.patches.flatMap(({ corners }) => corners).map((corner) => view.project(corner))
      .every(([x, y]) => x >= 0 && x <= view.width && y >= 0 && y <= view.height);
    say("no room is cut off", lesson.figure.views.filter((view) => view.room).every(inside));
    say("the figure has a sentence and a table", document.querySelector(".sentence").textContent.length > 20 && all("details.numbers tbody tr").length > 0);
    say("no text is wider than the window", document.documentElement.scrollWidth <= window.innerWidth);
    say("all controls have names", all(".controls input, .controls select").every((input) => input.labels[0]?.textContent.length > 1));
    const inputs = all(".controls [data-key]");
    for (const input of only ? inputs : inputs.slice(0, 1)) {
      if (chapter.needs?.[input.dataset.key]) lesson.figure.set(chapter.needs[input.dataset.key]);
      const before = values() + pictures();
      if (input.type === "checkbox") input.checked = !input.checked;
      else if (input.type === "range") input.value = Number(input.value) === Number(input.max) ? input.min : input.max;
      else input.value = [...input.options].map((option) => option.value).find((value) => value !== input.value);
      input.dispatchEvent(new Event("input", { bubbles: true }));
      await settled();
      say(`${input.dataset.key} changes what is shown`, values() + pictures() !== before);
      say(`${input.dataset.key} is in the address`, location.hash.includes(`${input.dataset.key}=`));
      lesson.figure.set({ ...state, eye: lesson.figure.state.eye });
      await settled();
    }
    const [range] = all(".controls input[type=range]");
    if (range) {
      range.value = String((Number(range.min) + Number(range.max)) / 2);
      range.dispatchEvent(new Event("input", { bubbles: true }));
      await settled();
      const [hash, shown, sentence] = [location.hash, values(), document.querySelector(".sentence").textContent];
      await open(hash);
      await settled();
      say("the address restores it", chapter.timed ? location.hash === hash : values() === shown && document.querySelector(".sentence").textContent === sentence);
    }
    const room = document.querySelector("canvas.room");
    if (room) {
      const before = picture(room);
      key("ArrowLeft", room);
      await wait(300);
      say("an arrow key turns the room", picture(room) !== before && location.hash.includes("eye="));
    }
    all(".exercise").forEach((form, k) => {
      const exercise = exercises[k], input = form.querySelector("input, select"), answer = () => form.querySelector("output").className;
      const give = (text) => { input.value = text; form.requestSubmit(); };
      give(String(exercise.answer));
      const right = answer();
      give(typeof exercise.answer === "number" ? String(exercise.answer * 1.5 + 1) : exercise.choices.find((text) => text !== exercise.answer));
      say(`exercise ${k + 1} takes its answer and refuses another`, right === "right" && answer() === "wrong");
    });
    say("the source is named", document.querySelector(".source code") && document.querySelector(".source q").textContent.length > 10);
  };

  const ofChapters = {
    1: async () => {
      await open("#1");
      const { closed, exchange, rays, hits, share, areas } = lesson.figure.values;
      check("1. the closed form is that of the program", near(closed, expected.pair[0].F, 1e-12) && near(exchange / areas[1], expected.pair[1].F, 1e-12));
      check("1. it is that of Howell's catalogue, C-11", near(closed, 0.1998249, 1e-6));
      check("1. F by rays is hits over rays, within three standard errors of it", share === hits / rays && Math.abs(share - closed) < 3 * lesson.figure.values.error);
      key("r");
      check("1. a key shoots one ray", lesson.figure.values.rays === rays + 1);
      await open("#1?size=2&rays=4000");
      const { closed: larger, exchange: both, back } = lesson.figure.values;
      check("1. A F is the same both ways", near(both / 4, back, 0.15) && larger > closed);
      await open("#1?distance=0.1");
      check("1. the hemicube is off near by", Math.abs(lesson.figure.values.hemicube - lesson.figure.values.closed) > 0.02);
      await open("#1?distance=2");
      check("1. and not far away", Math.abs(lesson.figure.values.hemicube - lesson.figure.values.closed) < 0.01);
      const noise = [];
      for (const rays of [40, 4000]) { await open(`#1?rays=${rays}`); noise.push(lesson.figure.values.error); }
      states(1, "for one digit more you need a hundred times as many rays", near(noise[0] / noise[1], 10, 0.35));
    },
    2: async () => {
      await open("#2?bounces=13");
      check("2. all bounces give the light of the program's matrix", close(lesson.figure.values.light, expected.small.light, 1e-8));
      const { factors, chosen, patches } = lesson.figure.values;
      const row = Array.from({ length: patches }, (_, j) => expected.small.factors.find((pair) => pair.i === chosen && pair.j === j)?.F ?? 0);
      check("2. a row is that of the program", close(factors, row, 1e-9));
      check("2. it sums to 1, and has 0 for the patch itself", near(factors.reduce((a, b) => a + b), 1, 1e-6) && factors[chosen] === 0);
      const room = lesson.figure.views.find((view) => view.room).room.patches, { normal, centre } = room[chosen];
      const inPlane = room.filter((other) => Math.abs(centre.reduce((sum, x, k) => sum + (other.centre[k] - x) * normal[k], 0)) < 1e-9);
      states(2, "nor others in its own plane", inPlane.length > 1 && inPlane.every(({ index }) => factors[index] === 0));
      const missing = [];
      for (const bounces of [5, 6]) { await open(`#2?bounces=${bounces}`); missing.push(lesson.figure.values.missing); }
      check(`2. six bounces leave less than 1 % (${figures.percent(missing[1])}), five do not`, missing[1] < 0.01 && missing[0] > 0.01);
      for (const rho of [0.3, 0.5, 0.8]) {
        const left = [];
        for (const bounces of [2, 3, 6]) { await open(`#2?bounces=${bounces}&reflectance=${rho}`); left.push(lesson.figure.values.missing); }
        const [once, later] = [left[1] / left[0], (left[2] / left[1]) ** (1 / 3)];
        states(2, "it brings at most ρ times as much as the one before", once <= rho && later <= rho && later > 0.8 * rho);
      }
      await open("#2?bounces=6&reflectance=0.9");
      check("2. at 0.9 six bounces are not enough", lesson.figure.values.missing > 0.1);
      await open("#2");
      const ceiling = 20 * 3;
      check("2. after one bounce the ceiling is black", lesson.figure.values.light[ceiling] === 0 && lesson.figure.values.all[ceiling] > 0);
      await open("#2?bounces=2");
      states(2, "its first light comes with the second bounce", lesson.figure.values.light[ceiling] > 0);
      await open("#2?bounces=13&lamp=2");
      const light = lesson.figure.values.light;
      check("2. twice the lamp is twice the light", close(light.map((value) => value / 2), expected.small.light, 1e-8));
    },
    3: async () => {
      for (const method of ["progressive", "monte-carlo", "progressive-monte-carlo"]) {
        await open(`#3?method=${method}&steps=${method === "progressive-monte-carlo" ? 4 : 3}`);
        await settled();
        const { light, rays } = lesson.figure.values, program = expected[method];
        check(`3. ${method}: the light is the program's, to the last bit`, same(light, program.light));
        check(`3. ${method}: so is the number of rays`, rays === program.rays);
      }
      const errors = {};
      for (const steps of [4, 16]) { await open(`#3?steps=${steps}&method=progressive-monte-carlo`); errors[steps] = lesson.figure.values.error; }
      check("3. four times the steps halve the error", near(errors[16] / errors[4], 0.5, 0.2));
      const first = {};
      for (const method of ["progressive", "monte-carlo", "progressive-monte-carlo"]) { await open(`#3?steps=1&method=${method}`); first[method] = lesson.figure.values; }
      states(3, "For the third it starts low", 2 * first["progressive-monte-carlo"].error < Math.min(first.progressive.error, first["monte-carlo"].error));
      for (const method of ["progressive", "monte-carlo"]) {
        const shots = [first[method]];
        for (const steps of [8, 30]) { await open(`#3?steps=${steps}&method=${method}`); shots.push(lesson.figure.values); }
        states(3, "it falls as light is shot", shots.every(({ error, unshot }, k) => k === 0 || (error < shots[k - 1].error && unshot < shots[k - 1].unshot)));
      }
      await open("#3?steps=4&method=progressive");
      const four = lesson.figure.values, shone = lesson.figure.views.find((view) => view.room).room.patches;
      const behind = shone.filter(({ index }) => [0, 1, 2].every((c) => four.light[3 * index + c] === 0));
      await open("#3?steps=5&method=progressive");
      states(3, "The lamp shoots first, then what it has lit", behind.length > 0 && behind.some(({ index }) => lesson.figure.values.light[3 * index] > 0));
      await open("#3?steps=0");
      check("3. before the first shot only the lamp shines", lesson.figure.values.light.filter((value) => value > 0).length === 3 * 4);
    },
    4: async () => {
      let vertices = 0, narrow = 0;
      for (let patch = 0; patch < expected.crowd.light.length / 3; ++patch) {
        if (patch === 0) await open("#4");
        lesson.figure.set({ patch });
        vertices += lesson.figure.values.vertices;
      }
      check("4. the vertices of all patches are the density rays of the program", vertices === expected.crowd.densityRays);
      lesson.figure.set({ threshold: 2 });
      for (let patch = 0; patch < expected.crowd.light.length / 3; ++patch) {
        lesson.figure.set({ patch });
        narrow += lesson.figure.values.vertices;
      }
      check("4. a higher threshold takes fewer bytes, as many as in the program", narrow === expected.threshold.densityRays && narrow < vertices);
      const table = hemilux.hemisphere(2), leaves = table.cells.filter(({ level }) => level === 2);
      check("4. a full tree has 84 triangles and 41 vertices", table.cells.length === 84 && table.vertices.length === 41 && leaves.length === 64);
      const shares = leaves.map(({ projected, solidAngle }) => projected / solidAngle);
      states(4, "those at the rim are narrow", Math.max(...shares) > 4 * Math.min(...shares));
      const rim = Math.min(...leaves.map(({ projected }) => projected)), low = leaves.find(({ projected }) => projected === rim);
      states(4, "those at the rim are narrow", low.vertex.some((v) => Math.abs(table.vertices[v][2]) < 1e-9));
      await open("#4");
      check("4. 1997 takes 2132 bytes", document.querySelector(".sentence").textContent.includes("2132 bytes"));
    },
    5: async () => {
      await open("#5");
      const { rows, total } = lesson.figure.values, sum = (name) => rows.reduce((all_, row) => all_ + row[name], 0);
      check("5. shares of area and of power sum to 1, N_tr to N_hemi", near(sum("A"), 1, 1e-9) && near(sum("power"), 1, 1e-9) && near(sum("N"), 64, 1e-6) && total === 64);
      // The shares of the figure, shot for all patches, are the program's method.
      const room = new hemilux.Room(rooms.crowd({ things: 4 })), table = hemilux.hemisphere(2);
      const shoot = (rules, options) => {
        const run = room.runOwn((patch) => hemilux.shares(hemilux.leaves(table, room.counts(patch, 2), 0), rules), options).step().step();
        const light = run.light;
        run.delete();
        return light;
      };
      check("5. these shares give the program's light, to the last bit", same(shoot({}, {}), expected.crowd.light));
      check("5. and as printed, the light of --literal", close(shoot({ sphere: true, zero: true }, { fromCentre: true, rounded: true }), expected.printed.light, 1e-12));
      room.delete();
      await open("#5?rules=printed&rays=16");
      check("5. as printed with few rays power is lost", lesson.figure.values.lost > 0.02);
      await open("#5?rules=printed");
      const narrow = lesson.figure.values.rows.find(({ cell }) => cell === rows.at(-1).cell);
      check("5. the printed areas are others", narrow && !near(narrow.A, rows.at(-1).A, 0.05));
    },
    6: async () => {
      const set = async (rules) => { await open(`#6?sphere=false&${rules}`); return { ...lesson.figure.values }; };
      const right = await set(""), sphere = await set("sphere=true"), flat = await set("sphere=true&depth=0"), centre = await set("centre=true");
      check(`6. the corrected rules are right within their error (${figures.percent(right.off)})`, right.off < 1.5 * right.estimated);
      check(`6. D1: wrong (${figures.percent(sphere.off)}), and neither the balance nor the estimate notices`, sphere.off > 2 * sphere.estimated && Math.abs(sphere.missing) < 0.01);
      const patches = lesson.figure.views.find((view) => view.room).room.patches, brightest = (light) => patches.map(({ index }) => index).sort((a, b) => light[3 * b] - light[3 * a]);
      const sides = [0, 1, 2].map((k) => patches.map(({ corners }) => corners.map((corner) => corner[k])).flat());
      const atWall = ({ corners }) => [0, 1, 2].reduce((sum, k) => sum + (corners.some((corner) => corner[k] === Math.min(...sides[k]) || corner[k] === Math.max(...sides[k])) ? 1 : 0), 0);
      states(6, "Corners get it", brightest(sphere.light).slice(0, 8).every((index) => atWall(patches[index]) >= 2));
      const longer = await set("sphere=true&rays=512");
      states(6, "more rays make it small, and the true error stays", longer.estimated < 0.5 * sphere.estimated && near(longer.off, sphere.off, 0.1));
      check("6. at depth 0 the fault of D1 is gone", flat.off < 1.5 * flat.estimated);
      const more = await set("centre=true&rays=512");
      check(`6. D2: some 2 % stay, however many rays (${figures.percent(centre.off)}, ${figures.percent(more.off)})`, near(more.off, 0.02, 0.3) && more.off > 1.8 * more.estimated && Math.abs(more.missing) < 0.01);
      const few = await set("rounded=true&rays=4"), many = await set("rounded=true&rays=128");
      check(`6. D4: power is lost, more of it by fewer rays (${figures.percent(few.missing)}, ${figures.percent(many.missing)})`, few.missing > 0.1 && few.missing > 5 * Math.abs(many.missing));
      check("6. D5: in a closed room nothing counts 0", same((await set("zero=true&depth=0")).light, (await set("depth=0")).light));
      const sky = await set("room=open&zero=true"), seen = await set("room=open");
      check(`6. D5: without a ceiling the power towards the sky is not shot (${figures.percent(sky.missing)})`, sky.missing > 0.1 && Math.abs(seen.missing) < 0.01);
      const printed = await set("sphere=true&centre=true&rounded=true&zero=true");
      check("6. all rules of the print give the light of --literal", close(printed.light, expected.furnace.light, 1e-12));
    },
    7: async () => {
      await open("#7");
      await settled();
      const { errors, rays } = lesson.figure.values;
      const least = (method) => Math.min(...errors[method]);
      check(`7. stored transport is far below (${figures.percent(least("stored-transport"))}, hemisphere ${figures.percent(least("hemisphere"))})`, least("stored-transport") < 0.5 * least("hemisphere"));
      const shot = errors["progressive-monte-carlo"], slope = Math.log(shot.at(-1) / shot[2]) / Math.log(rays["progressive-monte-carlo"].at(-1) / rays["progressive-monte-carlo"][2]);
      check(`7. shooting falls with a slope of −1/2 (${slope.toFixed(2)})`, near(slope, -0.5, 0.25));
      const shots = errors.progressive;
      states(7, "hardly falls at first and then bends down", shots[0] > 0.3 && shots.at(-1) < 0.25 * shots[0]);
      // Which is first by the clock is not tested; which needs fewer rays is.
      const { first } = lesson.figure.values, raysTo = (method) => rays[method][errors[method].findIndex((error) => error <= 0.05)] ?? Infinity;
      check("7. the sentence names a method with a useful picture", first && least(first) <= 0.05 && document.querySelector(".sentence").textContent.includes(first));
      check("7. stored transport has one after fewer rays than shooting", raysTo("stored-transport") < Math.min(...["hemisphere", "stratified", "monte-carlo", "progressive-monte-carlo"].map(raysTo)));
      const { bars, reference } = lesson.figure.values;
      check("7. the chart has all curves", colours(document.querySelector("canvas.chart")) > 60);
      check("7. every point of three runs has an error bar", Object.values(bars).every((list) => list.length > 0 && list.every((bar) => bar > 0)));
      check(`7. the bars are standard errors of means: shorter than the errors (${figures.percent(bars["monte-carlo"][0])} of ${figures.percent(errors["monte-carlo"][0])})`,
        bars["monte-carlo"].every((bar, k) => bar < 0.5 * errors["monte-carlo"][k]));
      check(`7. the reference is within 0.3 % (${figures.percent(reference)}), and no method is nearer to it`, reference <= 0.003 && Math.min(...Object.keys(errors).map(least)) > reference);
      await open("#7?runs=1&seconds=0.25");
      await settled();
      check("7. a single run has no bars", Object.values(lesson.figure.values.bars).flat().every((bar) => bar === 0));
      const room = new hemilux.Room(rooms.boxes({ n: 6 })), run = room.run("stored-transport", { steps: 2 }).step().step();
      check("7. the default method has the program's light, to the last bit", same(run.light, expected.stored.light));
      run.delete();
      room.delete();
      await open("#7?room=room_1002&runs=2&seconds=0.25&useful=1");
      await settled();
      const paper = lesson.figure.values, at = paper.errors["stored-transport"].findIndex((error) => error <= 0.01);
      check(`7. in the paper's room the default method reaches 1 % (${figures.format(paper.rays["stored-transport"][at])} rays)`, at >= 0 && paper.rays["stored-transport"][at] < 3e5);
      check(`7. the sentence names it (${paper.first})`, paper.first === "stored-transport" && document.querySelector(".sentence").textContent.startsWith("The first picture within 1 % is by stored-transport"));
      check("7. shooting does not with as many rays", paper.errors.hemisphere.every((error, k) => error > 0.01 || paper.rays.hemisphere[k] > 3e5));
      const hall = new hemilux.Room(rooms.example("room_1002")), solver = hall.run("stored-transport");
      do solver.step(); while (solver.figures.error > 0.01);
      check("7. when its own estimate is 1 % it has the program's light, to the last bit", hall.patches.length === 1002 && same(solver.light, expected.example.light) && solver.figures.rays === expected.example.rays);
      solver.delete();
      hall.delete();
    },
    8: async () => {
      const guides = {};
      for (const wall of [true, false]) {
        await open(`#8?wall=${wall}`);
        guides[wall] = Object.fromEntries(lesson.figure.values.results.map((result) => [result.name, result]));
      }
      const spread = (of) => Math.max(...Object.values(of).map(({ all: error }) => error)) / Math.min(...Object.values(of).map(({ all: error }) => error));
      check("8. all guides shoot about as many rays", Object.values(guides.true).every(({ rays }) => near(rays, guides.true.none.rays, 0.05)));
      check("8. without the screen the things get better by counts", guides.false.counts.detail < guides.false.none.detail);
      states(8, "these get better and the rest gets worse", guides.false.counts.detail < guides.false.none.detail && guides.false.counts.all > guides.false.none.all);
      states(8, "Yet the things gain here even so", guides.true.counts.detail < guides.true.none.detail);
      check(`8. the gain is small: the best and the worst of all surfaces differ by less than a quarter (${spread(guides.true).toFixed(2)}, ${spread(guides.false).toFixed(2)})`, spread(guides.true) < 1.25 && spread(guides.false) < 1.25);
    },
    9: async () => {
      await open("#9");
      const { ratio, curves } = lesson.figure.values;
      await open("#9?reflectance=0.85");
      const bright = lesson.figure.values.ratio, brighter = lesson.figure.values.curves;
      check(`9. shooting needs many times the rays (${ratio.toFixed(0)}), more in a brighter room (${bright.toFixed(0)})`, ratio > 5 && bright > ratio);
      states(9, "the same rays serve all the further bounces, and their error hardly grows", curves.stored.every(([rays, error], k) =>
        near(brighter.stored[k][0], rays, 0.01) && brighter.stored[k][1] < 1.2 * error));
    },
    10: async () => {
      const at = async (rest) => { await open(`#10?${rest}`); return { ...lesson.figure.values }; };
      const coarse = await at("cells=3"), middle = await at("cells=6"), fine = await at("cells=12"), many = await at("cells=6&rays=1024");
      check(`10. patches half as wide halve the error (${[coarse, middle, fine].map(({ patches }) => figures.percent(patches)).join(", ")})`, near(middle.patches / fine.patches, 2, 0.3));
      check(`10. gathers are far better than the patches that they come from (${figures.percent(middle.gathered)})`, middle.gathered < 0.5 * middle.patches);
      check("10. more rays of a gather leave less noise", many.gathered < middle.gathered);
      check("10. the reference has 1024 patches", fine.count === 1024);
      // A reader's room, by the file input and dropped.
      const sentence = () => document.querySelector(".sentence").textContent;
      const carry = (texts) => {
        const data = new DataTransfer();
        for (const [name, content] of Object.entries(texts)) data.items.add(new File([content], name));
        return data;
      };
      const until = async (holds) => { for (let tries = 0; tries < 500 && !holds(); ++tries) await wait(20); };
      const choose = async (texts) => {
        const before = sentence(), input = document.querySelector("input[type=file]");
        input.files = carry(texts).files;
        input.dispatchEvent(new Event("change"));
        await until(() => sentence() !== before);
      };
      const drop = async (texts) => {
        const before = sentence();
        document.querySelector(".views canvas").dispatchEvent(new DragEvent("drop", { dataTransfer: carry(texts), bubbles: true, cancelable: true }));
        await until(() => sentence() !== before);
      };
      const { obj, mtl } = rooms.files.room_1002, ownIs = () => {
        const { light, rays, count } = lesson.figure.values;
        return count === 1002 && light && same(light, expected.own.light) && rays === expected.own.rays;
      };
      for (const [how, give] of [["chosen", choose], ["dropped", drop]]) {
        await open("#10");
        const before = pictures();
        await give({ "room.obj": obj, "room.mtl": mtl });
        check(`10. a ${how} OBJ has the program's light, to the last bit (${sentence()})`, ownIs() && sentence().startsWith("Your room has 1002 patches."));
        check(`10. a ${how} OBJ changes the figure`, pictures() !== before && all("details.numbers tbody tr").length === rooms.example("room_1002").materials.length);
      }
      all(".controls button").find(({ textContent }) => textContent.startsWith("Back")).click();
      check("10. a button goes back to the room with two boxes", sentence().startsWith("On 256 patches"));
      const lamp = "newmtl lamp\nKd 0.5 0.5 0.5\nKe 1 1 1\n", square = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl lamp\n";
      const bad = [
        ["without an OBJ", { "room.txt": "hello" }, "an OBJ file is expected, with its MTL file beside it"],
        ["of something else", { "room.obj": "\x00\x01PNG" }, "the OBJ has no face (f)"],
        ["with a word for a number", { "room.obj": "v 0 0 0\nv 1 zero 0\n" }, "line 2 of the OBJ: a vertex has three numbers"],
        ["with a corner that is not there", { "room.obj": `${square}f 1 2 9\n`, "room.mtl": lamp }, "line 5 of the OBJ: there is no vertex 9"],
        ["with a face of two corners", { "room.obj": `${square}f 1 2\n`, "room.mtl": lamp }, "line 5 of the OBJ: a face has three corners at least"],
        ["whose faces are points", { "room.obj": `${square}f 1 1 1\n`, "room.mtl": lamp }, "its faces have no area"],
        ["without a lamp", { "room.obj": `${square}f 1 2 3\n` }, "nothing emits light: choose the MTL file too"],
        ["with a dark MTL", { "room.obj": `${square}f 1 2 3\n`, "room.mtl": "newmtl lamp\nKd 0.5 0.5 0.5\n" }, "nothing emits light: a material of the MTL needs Ke"],
        ["with a reflectance of 2", { "room.obj": obj, "room.mtl": "newmtl wall\nKd 2 0.5 0.5\n" }, "line 2 of the MTL: Kd has three numbers from 0 to 1"],
        ["with a colour of nothing", { "room.obj": obj, "room.mtl": "Kd 0.5 0.5 0.5\n" }, "line 1 of the MTL: newmtl stands before Kd"],
        ["that is too large", { "room.obj": square + "f 1 2 3\n".repeat(10001), "room.mtl": lamp }, "it has 10001 faces, and this page takes 10000 at most"],
      ];
      for (const [what, texts, message] of bad) {
        await choose(texts);
        check(`10. a file ${what} gets one message: ${sentence()}`, lesson.figure.values.count === 256 && sentence() === `This file cannot be shown: ${message}.`);
      }
    },
  };

  const only = new URLSearchParams(location.search).get("only"); // one chapter; else the frame and all
  const chapters = lesson.chapters.filter((chapter) => chapter && (!only || chapter.number === Number(only)));
  const ofFrame = async () => {
    location.hash = "#0";
    await wait(300);
    check("the cover shows a solved room", lesson.cover && colours(document.querySelector(".live canvas")) > 50);
    check("the cover lists all chapters", all(".contents a").length === chapters.length);
    key("n");
    await wait(100);
    check("n turns to chapter 1", location.hash.startsWith("#1"));
    key("p");
    check("p is for a projector", document.body.classList.contains("present"));
    key("Escape");
    check("Escape ends that", !document.body.classList.contains("present"));
    location.hash = "#worksheet";
    await wait(100);
    check("the worksheet has all exercises", all(".questions li").length === chapters.reduce((sum, { exercises }) => sum + exercises.length, 0));
    location.hash = "#plan";
    await wait(100);
    check("there is a plan", all("main tr").length > 5);
  };
  if (!only) await ofFrame();
  for (const chapter of chapters) {
    try {
      await asChapter(chapter);
      if (only) await ofChapters[chapter.number]?.();
    } catch (error) {
      check(`${chapter.number}. ${error.stack}`, false);
    }
  }
  document.body.replaceChildren(lesson.element("pre", { id: "checks" }, [...lines, "all checks ran"].join("\n")));
})();
