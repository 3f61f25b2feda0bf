// The video of the self-test: two frames of a grid of 16 x 5 vertices whose coordinates have bytes from 0 to 255, in VP9
// packets; and what the first row of low bytes of the second frame holds.

/** In base 64. */
export const testPackets: readonly string[] = [
  "okmDQuAA8ACmADgkHBgAAAAgAAB+dHkCf/rx7OF0VT////5GIf/q1//QfrKUHg/6l/HvP/ekPpO5QxUgeTqDyq2TP9d/TvHO5X/Lv/hS81s9pr" +
    "N/20tR+s/Y8B///GVufhvv9MyDKp4A/vGH7JL5sxwDRYzr////huc0zHpnw8f88WHEjLHgvyV6QfpLn2KehnsU/+GuzLqNtf///ob/////f3ES" +
    "3//uMtzX3kr9/9mPgtSTni3//oR//23j89T+sN9oen/7Ff/zad9HfD65OoEsdkO/kz16/cEeN/bZ9hP//1BmRp5/AS///80////+Y7943///5h" +
    "p//5h7n////zHf///mbh8m3r/0L4C7/wA33d7+mjv6AC9S/j36l////S/Rbg59v/7R+7hjFJdNf85CMdnVsH6dTvHfNPf//wAfqGeLRGRpV6eN" +
    "7su/x2+vW7qZTVPxW355cmgLhf//3FivLfHP//Iu/4fv9Xl/MNP/2Gf/YN/Dkf/4UXU0Zgf/XVB3LJvxY//7PjCRP/brABXfaNpDMup9imR77a" +
    "0JaSP/+nv/QW//9hn/9dc5kr/6nF///2/n/8bJfSdf/8Lv/sp/o5q89/PQ/iZCe//2gn+4/1W+up+67za//i1cKDQrBb17f/xhY9C9r6jmCL6G" +
    "V/ex0P5mlbL7vZvpo/tTf+t/FI9gQa5PzUvkznfnQxvtAu4xqav+7Cbmf8M7/mFmu9u8Uyb8B2t9+kIYR778b/02r8UZ9I73I//Fj1arnc/o59" +
    "ofJSt2OtSfxq+xZfX+69aSX//xeuchAK33O7Kt+Vf/0DzNL5Ekz76E7yPk1//6e33WDUf/wf8r+/4aYs6KKmzfhVWfxNuIp/8T/aAjySo+jH+t" +
    "7Sumrqjq99YVzmjbvbuP/y9P8oSb50H+GeH0Y+Co6v88dd4Sqjr+////7xzydWty7e/us/Jz+gyP+VN35cqA3///ouyqJ5xoY/LQ1//+jswuJy" +
    "F/8Jr/+EJP///0S34fJvRvthsP7E0M/+1tDMsWP9/MGU/TbJGailkryRb7yvpRo1rGIiYnHuqf//8290mj/5qv/z/q/1+f5VX/KF//AAF///mr" +
    "Z/moH//+vC94p6Z+OL0ffz+n3kY/LJzqjV0iZ2PyR/8+f//9392J2M7ESPvvr///7r5Nr/8vOz/8zh//MjP////K7PXRnLhkTs7UV7U17PwmvK" +
    "Ljfxqt+lPrb7RA",
  "pgBAkvABAAAACAAAcbpP//3PpdVW61fYTe8APyf2urF//aYebcf4inv6IaBhfQWwA//lbTWz/ATxhB83wFNy/35/+0HsJHX1zX//44I/P8r5/m" +
    "6mHZ/+4l6g/916i1P0i8XW////9GZZTd5/0QdHw8On3ALJxCcj///94HIT+T/dQ+yLqSXp/p2X+pfOfygdqHuPfyf/9lj////5Om7f//UIf+x9" +
    "ba/+Gt+tuVrzf/YX/+o9//zgD//+h2Q//jXnv/4wL35IGl//EjQ9F/ZhjxS////GN7ituHbAve5JsT4mvq3IAfo0f6C2nBJrZ4G//87Cf/SR//" +
    "/8Lcl4ZzSF7P/8XHmbf/uf/6w92cta4WQLP82P0fDqHzULUhu//JV///+Rf///45l6nLOb046EpzO/i1+S/Oev/nTQK9zP//joO3tbhwfXanxV" +
    "crRVxVf/OM//Xf6xeNH/vmX//YD/4d/+Z8ZUbJORf2BvX/+bekYpKCzCsrVuY4FNtsQH//lOlB1oXHS+Hk//7cT9N/+Yy59P7/LwB9//+NGXvP" +
    "//5mf//Es9pHwC9fQoH///2hd////M/f//gK2ri1N//+g+f/1Vv+R0pw9f6Z//xp8P//GM6bCKeBQI9AJi3WSSJSmtv+P/Uv///wb39V9hI9Vf" +
    "+sJX+ArWvfn///uOsyrdf/FT/6j3//+NErl//+Lf//8yz8B+Vful2F///94L9Rj9i+/nmF+loefhj7Jfal76f+9r/9xmem/++H/9UQ//5p+nfn" +
    "PLgzGo/o90+3u9V7w42Pgj7qvJdzv//gHBb9wv6i0RzfCr5rL/73LHO50/saYzzEn/+7HipkF/vV/VL+0jwh7fkpuvYrPV5dok5TkEGMf+6luS" +
    "Ph9EOj37SGi4snn7Os3EAjJO7Px////xY/mk3aQ7KJ1KvQv9RRn/LKXnx1IjgfHOt/+/9vfwSnxQ+Cmucsfzvu3oi8I4j/qx/4oJ////Hi/Qof" +
    "Kpamy78sJS7gr4KypD/fJ8McLdxWuf//7Rb5uV95nm3L/+ez6yWrPZWnV5RWL+kXwL3r7HTbFNuXf3HCr5gf/luR9LbjltDXh//xnvsLYJUnnr" +
    "sYpQWeT+9M79if/74HAHwLtWKsH/S1IF7Y1XW2ngXy4eCT/J5/6pf/8mvbfYntf8pb4f/ZVp3/kv9Dv/6m//pyv/6p6HIj5x/z9393nStf9+gf" +
    "/fsX//+kjk0NeZ3IG712pn9vtwVqV/8sP/yQAA",
];

/** Red, green and blue of each column. */
export const testRow: readonly number[] = [
  165, 206, 247, 209, 79, 205, 162, 117, 72, 115, 155, 195, 68, 193, 62, 21, 231, 185, 230, 13, 52, 92, 216, 84, 136,
  89, 42, 89, 127, 165, 42, 165, 32, 251, 203, 155, 204, 241, 22, 157, 23, 145, 19, 226, 177, 63, 99, 135,
];
