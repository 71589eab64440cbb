// What is really on the screen: pixels of a screenshot, and those of the heat map's tiles.

// The pixels of a screenshot as { width, height, data: [r, g, b, a, ...] } (decoded by the page, which is at hand).
export async function screen(page, clip) {
  const bytes = await page.screenshot({ clip });
  const { width, height, text: pixels } = await page.evaluate(async (text) => {
    const binary = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const picture = await createImageBitmap(new Blob([binary], { type: 'image/png' }));
    const pen = new OffscreenCanvas(picture.width, picture.height).getContext('2d');
    pen.drawImage(picture, 0, 0);
    const { data } = pen.getImageData(0, 0, picture.width, picture.height);
    const letters = [];
    for (let i = 0; i < data.length; i += 8192) letters.push(String.fromCharCode(...data.subarray(i, i + 8192)));
    return { width: picture.width, height: picture.height, text: btoa(letters.join('')) };
  }, bytes.toString('base64'));
  return { width, height, data: Buffer.from(pixels, 'base64') };
}

export function countPixels({ data }, accept) {
  let count = 0;
  for (let i = 0; i < data.length; i += 4) if (accept(data[i], data[i + 1], data[i + 2])) ++count;
  return count;
}

// inferno's colours from few to many: far more red than the blue-grey of the base map.
export const hot = (r, g, b) => r > 90 && r > b + 20 && r > 1.3 * g;

// Any of them, the darkest too.
export const lit = (r, g, b) => Math.max(r, b) > g + 35;

// How many pixels of the tiles are drawn, and a sum that tells pictures apart.
export const tiles = (page) => page.evaluate(() => {
  const result = { drawn: 0, sum: 0 };
  for (const tile of document.querySelectorAll('.heat-tile')) {
    const { data } = tile.getContext('2d').getImageData(0, 0, tile.width, tile.height);
    for (let i = 0; i < data.length; i += 4) {
      if (!data[i + 3]) continue;
      ++result.drawn;
      result.sum = (result.sum * 31 + i + data[i] + 7 * data[i + 1]) % 1000000007;
    }
  }
  return result;
});
