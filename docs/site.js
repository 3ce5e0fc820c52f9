// A picture of a live page gives way to the page when it is clicked. Without scripts, its link opens the page.
addEventListener('click', (event) => {
  const figure = event.target.closest?.('figure.live');
  const link = event.target.closest?.('a');
  if (!figure || !link || event.ctrlKey || event.metaKey || event.shiftKey) return;
  event.preventDefault();
  const frame = document.createElement('iframe');
  frame.src = link.href;
  frame.title = figure.querySelector('img').alt;
  frame.allow = 'fullscreen';
  figure.querySelector('img').closest('a').replaceWith(frame);
  const caption = figure.querySelector('figcaption a');
  caption.textContent = 'Open it on a page of its own';
  caption.target = '_blank';
  figure.classList.remove('live');
  figure.classList.add('opened');
  frame.focus();
});
