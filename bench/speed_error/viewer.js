// Two images of a scene, one over the other: a slider shows more of the one or the other, a click or the keys flip them.
"use strict";
for (const viewer of document.querySelectorAll(".viewer")) {
  const views = JSON.parse(viewer.querySelector("script").textContent);
  const [first, second] = viewer.querySelectorAll("select");
  const [under, over] = viewer.querySelectorAll(".stage img");
  for (const view of Object.values(views)) view.difference ||= viewer.dataset.blank; // the reference's from itself
  const [slider] = viewer.querySelectorAll("input[type=range]");
  const [errors] = viewer.querySelectorAll("input[type=checkbox]");
  const caption = viewer.querySelector(".caption");
  const stage = viewer.querySelector(".stage");

  const source = (select) => {
    const view = views[select.value];
    return errors.checked ? view.difference : view.picture;
  };
  const show = () => {
    under.src = source(second);
    over.src = source(first);
    over.style.clipPath = `inset(0 ${100 - slider.value}% 0 0)`;
    const name = slider.value >= 100 ? first.value : slider.value <= 0 ? second.value : `${first.value} | ${second.value}`;
    caption.textContent = name + (errors.checked ? ": signed error, too dark is blue, too bright is red" : "");
    stage.setAttribute("aria-label", caption.textContent);
  };
  const flip = () => {
    slider.value = slider.value >= 50 ? 0 : 100;
    show();
  };
  const choose = (select, step) => {
    select.selectedIndex = (select.selectedIndex + step + select.length) % select.length;
    show();
  };
  stage.addEventListener("click", () => { stage.focus(); flip(); });
  stage.addEventListener("keydown", (event) => {
    const actions = {
      " ": flip, Enter: flip, e: () => { errors.checked = !errors.checked; show(); },
      ArrowLeft: () => choose(first, -1), ArrowRight: () => choose(first, 1),
      ArrowUp: () => choose(second, -1), ArrowDown: () => choose(second, 1),
    };
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
  // On paper nothing can be flipped: there all images stand side by side.
  const gallery = viewer.querySelector(".gallery");
  for (const [name, view] of Object.entries(views)) {
    const figure = gallery.appendChild(document.createElement("figure"));
    for (const [address, kind] of [[view.picture, ""], [view.difference, ": signed error"]]) {
      Object.assign(figure.appendChild(new Image()), { src: address, alt: name + kind });
    }
    figure.appendChild(document.createElement("figcaption")).textContent = name;
  }
  for (const control of [first, second, slider, errors]) control.addEventListener("input", show);
  show();
}
