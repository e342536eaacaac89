"use strict";
// What the page does beyond showing itself: themes, sorting, filters, and the place in the contents.
(() => {
  const root = document.documentElement;
  const store = {
    get() { try { return localStorage.getItem("theme"); } catch { return null; } },
    set(value) { try { localStorage.setItem("theme", value); } catch { /* a page from a file may have no store */ } },
  };

  const button = document.getElementById("theme");
  const system = matchMedia("(prefers-color-scheme: dark)");
  const dark = () => (root.dataset.theme || (system.matches ? "dark" : "light")) === "dark";
  const name = () => { button.textContent = dark() ? "light theme" : "dark theme"; };
  if (store.get()) root.dataset.theme = store.get();
  button.hidden = false;
  button.addEventListener("click", () => {
    root.dataset.theme = dark() ? "light" : "dark";
    store.set(root.dataset.theme);
    name();
  });
  system.addEventListener("change", name);
  name();

  const key = (row, column) => {
    const cell = row.cells[column];
    const text = cell.dataset.sort ?? cell.textContent.trim();
    const value = Number(text === "inf" ? Infinity : text);
    return text === "" || Number.isNaN(value) ? text : value;
  };
  const compare = (a, b) => (typeof a === "number" && typeof b === "number" ? (a > b) - (a < b) : String(a).localeCompare(String(b), "en", { numeric: true }));
  for (const table of document.querySelectorAll("table.sortable")) {
    const heads = [...table.tHead.rows[0].cells];
    heads.forEach((head, column) => {
      if (head.classList.contains("wide")) return; // bars, which the columns beside them say in figures
      const sorter = document.createElement("button");
      sorter.type = "button";
      sorter.append(...head.childNodes);
      head.append(sorter);
      sorter.addEventListener("click", () => {
        const upwards = head.getAttribute("aria-sort") !== "ascending";
        for (const other of heads) other.removeAttribute("aria-sort");
        head.setAttribute("aria-sort", upwards ? "ascending" : "descending");
        const body = table.tBodies[0];
        const rows = [...body.rows].map((row) => ({ row, key: key(row, column) }));
        rows.sort((a, b) => (upwards ? 1 : -1) * compare(a.key, b.key));
        body.append(...rows.map(({ row }) => row));
      });
    });
  }

  for (const filters of document.querySelectorAll(".filters")) {
    const rows = [...document.getElementById(filters.dataset.filters).tBodies[0].rows];
    const texts = rows.map((row) => row.textContent.toLowerCase());
    const buttons = [...filters.querySelectorAll("button")];
    const search = filters.querySelector("input");
    const apply = () => {
      const mood = buttons.find((one) => one.getAttribute("aria-pressed") === "true").dataset.mood;
      const wanted = search.value.trim().toLowerCase();
      rows.forEach((row, i) => { row.hidden = (mood && row.dataset.mood !== mood) || !texts[i].includes(wanted); });
      filters.querySelector("[role=status]").textContent = `${rows.filter((row) => !row.hidden).length} of ${rows.length} shown`;
    };
    for (const one of buttons) {
      one.addEventListener("click", () => {
        for (const other of buttons) other.setAttribute("aria-pressed", String(other === one));
        apply();
      });
    }
    search.addEventListener("input", apply);
    filters.hidden = false;
  }
  // A link to a row that a filter hides shows it.
  const reveal = () => {
    const row = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (row?.hidden) { row.hidden = false; row.scrollIntoView(); }
  };
  addEventListener("hashchange", reveal);

  const links = new Map([...document.querySelectorAll("nav ol a")].map((link) => [document.getElementById(link.hash.slice(1)), link]));
  const places = [...links.keys()].filter(Boolean);
  let waiting = false;
  const mark = () => {
    waiting = false;
    const passed = places.filter((place) => place.getBoundingClientRect().top < 120);
    const here = passed.at(-1) ?? places[0];
    for (const [place, link] of links) {
      if (place === here || place?.contains(here)) link.setAttribute("aria-current", "true");
      else link.removeAttribute("aria-current");
    }
  };
  addEventListener("scroll", () => { if (!waiting) { waiting = true; requestAnimationFrame(mark); } }, { passive: true });
  mark();
})();
