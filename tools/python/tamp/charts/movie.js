// The slider shows the picture of a time, of the quantity that is chosen; Play goes on to the end.
"use strict";
{
  const movie = document.getElementById("movie");
  const data = JSON.parse(document.getElementById("movie-data").textContent);
  const slider = movie.querySelector("input[type=range]");
  const button = movie.querySelector("button");
  const choices = [...movie.querySelectorAll("input[type=radio]")];
  let timer = 0;

  function show() {
    const chosen = choices.find(choice => choice.checked).value;
    const k = Number(slider.value);
    for (const part of movie.querySelectorAll(".quantity")) {
      part.hidden = part.dataset.quantity !== chosen;
      if (part.hidden) continue;
      for (const image of part.querySelectorAll("img")) image.src = "data:image/png;base64," + data.pictures[chosen][k];
    }
    slider.setAttribute("aria-valuetext", data.times[k]);
    movie.querySelector("output").textContent = data.times[k];
  }

  function stop() {
    clearInterval(timer);
    timer = 0;
    button.textContent = "Play";
  }

  function go() {
    if (Number(slider.value) >= Number(slider.max)) return stop();
    slider.value = Number(slider.value) + 1;
    show();
  }

  button.addEventListener("click", () => {
    if (timer) return stop();
    if (slider.value === slider.max) slider.value = 0;
    timer = setInterval(go, 160);
    button.textContent = "Stop";
    show();
  });
  slider.addEventListener("input", () => { stop(); show(); });
  for (const choice of choices) choice.addEventListener("change", show);
  slider.value = movie.dataset.first;  // browsers keep what it was before the page was loaded again
  movie.querySelector(".controls").hidden = false;
  show();
}
