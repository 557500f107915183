'use strict';
// The cards: which picture is shown, and how much of the truth's is seen beside the technique's.
for (const card of document.querySelectorAll('.card[data-name]')) {
  const stage = card.querySelector('.stage');
  const over = stage.querySelector('.over');
  const slider = card.querySelector('.slider');
  const tabs = [...card.querySelectorAll('.tabs button')];
  const show = (tab) => {
    for (const other of tabs) other.setAttribute('aria-pressed', String(other === tab));
    over.src = tab.dataset.file;
    const whole = !tab.hasAttribute('data-slides');
    stage.classList.toggle('whole', whole);
    if (slider) slider.hidden = whole;
  };
  for (const tab of tabs) tab.addEventListener('click', () => show(tab));
  if (slider) slider.addEventListener('input', () => stage.style.setProperty('--cut', slider.value + '%'));
}
// The table: a click on a heading sorts by it, another one turns the order round.
for (const heading of document.querySelectorAll('th.sorts')) {
  const sort = () => {
    const down = heading.getAttribute('aria-sort') === 'ascending';
    const row = heading.parentElement;
    const column = [...row.children].indexOf(heading);
    const body = heading.closest('table').tBodies[0];
    const value = (line) => line.children[column].dataset.value ?? line.children[column].textContent;
    const compare = (a, b) => {
      const [p, q] = [value(a), value(b)];
      // What has no figure stands last, whichever way.
      if (p === '' || q === '') return p === q ? 0 : p === '' ? 1 : -1;
      const order = isNaN(p) || isNaN(q) ? p.localeCompare(q) : p - q;
      return down ? -order : order;
    };
    for (const other of row.children) other.removeAttribute('aria-sort');
    heading.setAttribute('aria-sort', down ? 'descending' : 'ascending');
    body.append(...[...body.rows].sort(compare));
  };
  heading.tabIndex = 0;
  heading.addEventListener('click', sort);
  heading.addEventListener('keydown', (event) => { if (event.key === 'Enter') sort(); });
}
// Says of each card whether all its pictures are there, to those who look after the page.
window.addEventListener('load', () => {
  for (const card of document.querySelectorAll('.card[data-name]'))
    card.toggleAttribute('data-ready', [...card.querySelectorAll('img')].every((image) => image.naturalWidth > 0));
});
