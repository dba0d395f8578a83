// Sliders: how much of the left picture lies over the right one.
for (const compare of document.querySelectorAll('.compare')) {
  const [before, after] = ['before', 'after'].map(name => compare.querySelector('.' + name));
  const [left, right] = ['left', 'right'].map(name => compare.querySelector('select.' + name));
  const slider = compare.querySelector('input');
  const show = () => {
    before.className = 'before ' + left.value;
    after.className = 'after ' + right.value;
    before.style.width = slider.value / 10 + '%';
  };
  for (const control of [left, right, slider]) control.addEventListener('input', show);
  // The picture follows the pointer, as if the whole of it were the slider's handle.
  compare.querySelector('.pair').addEventListener('pointermove', event => {
    const box = event.currentTarget.getBoundingClientRect();
    slider.value = 1000 * (event.clientX - box.left) / box.width;
    show();
  });
  show();
}
// One scene at a time.
for (const choice of document.querySelectorAll('.scene-choice')) {
  const scenes = [...choice.closest('section').querySelectorAll('.scene')];
  const names = new Set([...choice.options].map(option => option.value));
  const show = () => {
    for (const scene of scenes) if (names.has(scene.dataset.scene)) scene.hidden = scene.dataset.scene !== choice.value;
  };
  choice.addEventListener('input', show);
  show();
}
