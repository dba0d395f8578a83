// Two pictures, one over the other, and the border between them.

export class View {
  #box;
  #canvas;
  #left = null;
  #right = null;
  #split = 0.5;
  #zoom = "fit";
  /** What lies in the middle of the view, in shares of the picture. */
  #centre = { x: 0.5, y: 0.5 };

  constructor(box, canvas) {
    this.#box = box;
    this.#canvas = canvas;
    new ResizeObserver(() => this.#draw()).observe(box);
    box.addEventListener("pointerdown", (event) => this.#drag(event));
    box.addEventListener("keydown", (event) => this.#key(event));
  }

  /** Shows two pictures, `Pixels` or null. */
  async show(left, right) {
    const made = (pixels) => (pixels ? createImageBitmap(pixels.image()) : null);
    [this.#left, this.#right] = await Promise.all([made(left), made(right)]);
    this.#draw();
  }

  /** `fit`, or pixels of the screen for a pixel of the picture. */
  set zoom(zoom) {
    this.#zoom = zoom;
    this.#draw();
  }

  get #size() {
    const shown = this.#right ?? this.#left;
    return shown ? { width: shown.width, height: shown.height } : { width: 480, height: 300 };
  }

  /** Where the picture lies on the canvas. */
  #place(canvas) {
    const { width, height } = this.#size;
    const fit = Math.min(canvas.width / width, canvas.height / height);
    const scale = this.#zoom === "fit" ? fit : Number(this.#zoom) * devicePixelRatio;
    const along = (room, length, centre) => {
      const free = room - length * scale;
      return free >= 0 ? free / 2 : Math.min(0, Math.max(free, room / 2 - centre * length * scale));
    };
    return {
      scale,
      fit,
      x: along(canvas.width, width, this.#centre.x),
      y: along(canvas.height, height, this.#centre.y),
      width: width * scale,
      height: height * scale,
    };
  }

  #draw() {
    const canvas = this.#canvas;
    const { clientWidth, clientHeight } = this.#box;
    canvas.width = Math.round(clientWidth * devicePixelRatio);
    canvas.height = Math.round(clientHeight * devicePixelRatio);
    const context = canvas.getContext("2d");
    if (!this.#left && !this.#right) return;
    const place = this.#place(canvas);
    const border = place.x + Math.min(place.width, canvas.width - place.x) * this.#split;
    const put = (image, from, to) => {
      if (!image || to <= from) return;
      context.save();
      context.beginPath();
      context.rect(from, 0, to - from, canvas.height);
      context.clip();
      context.imageSmoothingEnabled = this.#zoom === "fit" && place.scale < 2;
      context.imageSmoothingQuality = "high";
      context.drawImage(image, place.x, place.y, place.width, place.height);
      context.restore();
    };
    const split = this.#left && this.#right ? border : this.#left ? canvas.width : 0;
    put(this.#left, 0, split);
    put(this.#right, split, canvas.width);
    if (this.#left && this.#right) this.#handle(context, border, place);
    this.#box.ariaValueNow = String(Math.round(this.#split * 100));
    this.#box.dataset.split = String(this.#split);
  }

  #handle(context, x, place) {
    const unit = devicePixelRatio;
    const [top, bottom] = [Math.max(0, place.y), Math.min(this.#canvas.height, place.y + place.height)];
    const y = (top + bottom) / 2;
    context.fillStyle = "#fff";
    context.shadowColor = "rgb(0 0 0 / 60%)";
    context.shadowBlur = 4 * unit;
    context.fillRect(x - unit, top, 2 * unit, bottom - top);
    context.beginPath();
    context.arc(x, y, 13 * unit, 0, 7);
    context.fill();
    context.shadowBlur = 0;
    context.strokeStyle = "#1d4ed8";
    context.lineWidth = 2 * unit;
    context.beginPath();
    for (const side of [-1, 1]) {
      context.moveTo(x + side * 3.5 * unit, y - 4.5 * unit);
      context.lineTo(x + side * 8 * unit, y);
      context.lineTo(x + side * 3.5 * unit, y + 4.5 * unit);
    }
    context.stroke();
  }

  /** A drag moves the border; in a picture that is larger than the view, one that begins away from it moves the picture. */
  #drag(event) {
    if (event.button !== 0) return;
    const box = this.#box.getBoundingClientRect();
    const place = this.#place(this.#canvas);
    const unit = devicePixelRatio;
    const visible = Math.min(place.width, this.#canvas.width - place.x);
    const border = (place.x + visible * this.#split) / unit;
    const moves = place.scale > place.fit && Math.abs(event.clientX - box.left - border) > 24;
    let last = { x: event.clientX, y: event.clientY };
    const move = ({ clientX, clientY }) => {
      if (moves) {
        this.#centre.x = clamp(this.#centre.x - ((clientX - last.x) * unit) / place.width);
        this.#centre.y = clamp(this.#centre.y - ((clientY - last.y) * unit) / place.height);
        last = { x: clientX, y: clientY };
      } else {
        this.#split = clamp(((clientX - box.left) * unit - place.x) / visible);
      }
      this.#draw();
    };
    if (!moves) move(event);
    this.#box.setPointerCapture(event.pointerId);
    this.#box.addEventListener("pointermove", move);
    const done = () => this.#box.removeEventListener("pointermove", move);
    this.#box.addEventListener("lostpointercapture", done, { once: true });
  }

  /** Arrows move the border, with Alt the picture. */
  #key(event) {
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const step = steps[event.key];
    if (event.key === "Home" || event.key === "End") this.#split = event.key === "End" ? 1 : 0;
    else if (step && event.altKey) {
      this.#centre.x = clamp(this.#centre.x + step[0] * 0.05);
      this.#centre.y = clamp(this.#centre.y + step[1] * 0.05);
    } else if (step) this.#split = clamp(this.#split + (step[0] - step[1]) * (event.shiftKey ? 0.1 : 0.02));
    else return;
    event.preventDefault();
    this.#draw();
  }
}

const clamp = (share) => Math.min(1, Math.max(0, share));
