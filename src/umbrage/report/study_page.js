'use strict';
// The pictures of a day: one at a time, by slider or one after the other.
const figures = [...document.querySelectorAll('.show figure')];
const slider = document.querySelector('.controls input');
const button = document.querySelector('.controls button');
let timer = 0;
const show = (index) => {
  figures.forEach((figure, i) => figure.classList.toggle('now', i === index));
  slider.value = index;
};
const stop = () => {
  clearInterval(timer);
  timer = 0;
  button.textContent = 'Play';
};
if (slider) {
  slider.addEventListener('input', () => {
    stop();
    show(Number(slider.value));
  });
  button.addEventListener('click', () => {
    if (timer) return stop();
    button.textContent = 'Stop';
    timer = setInterval(() => show((Number(slider.value) + 1) % figures.length), 600);
  });
  show(Math.floor(figures.length / 2));
}
// Says that all is there, to those who look after the page.
window.addEventListener('load', () => {
  document.body.toggleAttribute('data-ready', [...document.images].every((image) => image.naturalWidth > 0));
});
