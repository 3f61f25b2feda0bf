#include "documents/page_sanitizer.h"

#include "documents/element_writer.h"
#include "scene/mf_string.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace imgeo {

namespace {

/// The elements that are allowed in pages, sorted.
constexpr std::string_view allowedElements[] = {"AcousticProperties",
                                                "Analyser",
                                                "Anchor",
                                                "Appearance",
                                                "Arc2D",
                                                "ArcClose2D",
                                                "AudioClip",
                                                "AudioDestination",
                                                "Background",
                                                "BallJoint",
                                                "Billboard",
                                                "BiquadFilter",
                                                "BlendedVolumeStyle",
                                                "BooleanFilter",
                                                "BooleanSequencer",
                                                "BooleanToggle",
                                                "BooleanTrigger",
                                                "BoundaryEnhancementVolumeStyle",
                                                "BoundedPhysicsModel",
                                                "Box",
                                                "BufferAudioSource",
                                                "CADAssembly",
                                                "CADFace",
                                                "CADLayer",
                                                "CADPart",
                                                "CartoonVolumeStyle",
                                                "ChannelMerger",
                                                "ChannelSelector",
                                                "ChannelSplitter",
                                                "Circle2D",
                                                "ClipPlane",
                                                "CollidableOffset",
                                                "CollidableShape",
                                                "Collision",
                                                "CollisionCollection",
                                                "CollisionSensor",
                                                "CollisionSpace",
                                                "Color",
                                                "ColorChaser",
                                                "ColorDamper",
                                                "ColorInterpolator",
                                                "ColorRGBA",
                                                "ComposedCubeMapTexture",
                                                "ComposedTexture3D",
                                                "ComposedVolumeStyle",
                                                "Cone",
                                                "ConeEmitter",
                                                "Contact",
                                                "Contour2D",
                                                "ContourPolyline2D",
                                                "Convolver",
                                                "Coordinate",
                                                "CoordinateChaser",
                                                "CoordinateDamper",
                                                "CoordinateDouble",
                                                "CoordinateInterpolator",
                                                "CoordinateInterpolator2D",
                                                "Cylinder",
                                                "CylinderSensor",
                                                "DISEntityManager",
                                                "DISEntityTypeMapping",
                                                "Delay",
                                                "DirectionalLight",
                                                "Disk2D",
                                                "DoubleAxisHingeJoint",
                                                "DynamicsCompressor",
                                                "EXPORT",
                                                "EaseInEaseOut",
                                                "EdgeEnhancementVolumeStyle",
                                                "ElevationGrid",
                                                "EnvironmentLight",
                                                "EspduTransform",
                                                "ExplosionEmitter",
                                                "Extrusion",
                                                "FillProperties",
                                                "FloatVertexAttribute",
                                                "Fog",
                                                "FogCoordinate",
                                                "FontStyle",
                                                "ForcePhysicsModel",
                                                "Gain",
                                                "GeneratedCubeMapTexture",
                                                "GeoCoordinate",
                                                "GeoElevationGrid",
                                                "GeoLOD",
                                                "GeoLocation",
                                                "GeoMetadata",
                                                "GeoOrigin",
                                                "GeoPositionInterpolator",
                                                "GeoProximitySensor",
                                                "GeoTouchSensor",
                                                "GeoTransform",
                                                "GeoViewpoint",
                                                "Group",
                                                "HAnimDisplacer",
                                                "HAnimHumanoid",
                                                "HAnimJoint",
                                                "HAnimMotion",
                                                "HAnimSegment",
                                                "HAnimSite",
                                                "IMPORT",
                                                "ImageCubeMapTexture",
                                                "ImageTexture",
                                                "ImageTexture3D",
                                                "IndexedFaceSet",
                                                "IndexedLineSet",
                                                "IndexedQuadSet",
                                                "IndexedTriangleFanSet",
                                                "IndexedTriangleSet",
                                                "IndexedTriangleStripSet",
                                                "Inline",
                                                "IntegerSequencer",
                                                "IntegerTrigger",
                                                "IsoSurfaceVolumeData",
                                                "KeySensor",
                                                "LOD",
                                                "Layer",
                                                "LayerSet",
                                                "Layout",
                                                "LayoutGroup",
                                                "LayoutLayer",
                                                "LinePickSensor",
                                                "LineProperties",
                                                "LineSet",
                                                "ListenerPointSource",
                                                "LoadSensor",
                                                "LocalFog",
                                                "Material",
                                                "Matrix3VertexAttribute",
                                                "Matrix4VertexAttribute",
                                                "MetadataBoolean",
                                                "MetadataDouble",
                                                "MetadataFloat",
                                                "MetadataInteger",
                                                "MetadataSet",
                                                "MetadataString",
                                                "MicrophoneSource",
                                                "MotorJoint",
                                                "MovieTexture",
                                                "MultiTexture",
                                                "MultiTextureCoordinate",
                                                "MultiTextureTransform",
                                                "NavigationInfo",
                                                "Normal",
                                                "NormalInterpolator",
                                                "NurbsCurve",
                                                "NurbsCurve2D",
                                                "NurbsOrientationInterpolator",
                                                "NurbsPatchSurface",
                                                "NurbsPositionInterpolator",
                                                "NurbsSet",
                                                "NurbsSurfaceInterpolator",
                                                "NurbsSweptSurface",
                                                "NurbsSwungSurface",
                                                "NurbsTextureCoordinate",
                                                "NurbsTrimmedSurface",
                                                "OpacityMapVolumeStyle",
                                                "OrientationChaser",
                                                "OrientationDamper",
                                                "OrientationInterpolator",
                                                "OrthoViewpoint",
                                                "OscillatorSource",
                                                "PeriodicWave",
                                                "PhysicalMaterial",
                                                "PickableGroup",
                                                "PixelTexture",
                                                "PixelTexture3D",
                                                "PlaneSensor",
                                                "PointEmitter",
                                                "PointLight",
                                                "PointPickSensor",
                                                "PointProperties",
                                                "PointSet",
                                                "Polyline2D",
                                                "PolylineEmitter",
                                                "Polypoint2D",
                                                "PositionChaser",
                                                "PositionChaser2D",
                                                "PositionDamper",
                                                "PositionDamper2D",
                                                "PositionInterpolator",
                                                "PositionInterpolator2D",
                                                "PrimitivePickSensor",
                                                "ProjectionVolumeStyle",
                                                "ProximitySensor",
                                                "QuadSet",
                                                "ROUTE",
                                                "ReceiverPdu",
                                                "Rectangle2D",
                                                "RigidBody",
                                                "RigidBodyCollection",
                                                "ScalarChaser",
                                                "ScalarDamper",
                                                "ScalarInterpolator",
                                                "ScreenFontStyle",
                                                "ScreenGroup",
                                                "SegmentedVolumeData",
                                                "ShadedVolumeStyle",
                                                "Shape",
                                                "SignalPdu",
                                                "SilhouetteEnhancementVolumeStyle",
                                                "SingleAxisHingeJoint",
                                                "SliderJoint",
                                                "Sound",
                                                "SpatialSound",
                                                "Sphere",
                                                "SphereSensor",
                                                "SplinePositionInterpolator",
                                                "SplinePositionInterpolator2D",
                                                "SplineScalarInterpolator",
                                                "SpotLight",
                                                "SquadOrientationInterpolator",
                                                "StaticGroup",
                                                "StreamAudioDestination",
                                                "StreamAudioSource",
                                                "StringSensor",
                                                "SurfaceEmitter",
                                                "Switch",
                                                "TexCoordChaser2D",
                                                "TexCoordDamper2D",
                                                "Text",
                                                "TextureBackground",
                                                "TextureCoordinate",
                                                "TextureCoordinate3D",
                                                "TextureCoordinate4D",
                                                "TextureCoordinateGenerator",
                                                "TextureMatrixTransform",
                                                "TextureProjector",
                                                "TextureProjectorParallel",
                                                "TextureProperties",
                                                "TextureTransform",
                                                "TextureTransform3D",
                                                "TextureTransformMatrix3D",
                                                "TimeSensor",
                                                "TimeTrigger",
                                                "ToneMappedVolumeStyle",
                                                "TouchSensor",
                                                "Transform",
                                                "TransformSensor",
                                                "TransmitterPdu",
                                                "TriangleFanSet",
                                                "TriangleSet",
                                                "TriangleSet2D",
                                                "TriangleStripSet",
                                                "TwoSidedMaterial",
                                                "UniversalJoint",
                                                "UnlitMaterial",
                                                "Viewpoint",
                                                "ViewpointGroup",
                                                "Viewport",
                                                "VisibilitySensor",
                                                "VolumeData",
                                                "VolumeEmitter",
                                                "VolumePickSensor",
                                                "WaveShaper",
                                                "WindPhysicsModel",
                                                "WorldInfo"};
static_assert(std::ranges::is_sorted(allowedElements));

/// Attributes of HTML on which browsers act: global attributes, and those of elements that load or send data.
constexpr std::string_view activeAttributes[] = {
    "action",     "autofocus", "background", "contenteditable", "data",   "form", "formaction", "href",
    "http-equiv", "is",        "ping",       "popover",         "poster", "slot", "src",        "srcdoc",
    "srcset",     "style",     "tabindex",   "xlink:href",      "xmlns"};

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

} // namespace

bool isAllowedInPage(std::string_view element) {
  return std::ranges::binary_search(allowedElements, element);
}

bool isInertAttribute(std::string_view attribute) {
  const std::string name = lowerCase(attribute);
  const bool isHandler = name.starts_with("on") && name != "on"; // lights have a field `on`
  return !isHandler && name.find(':') == name.npos &&
         std::ranges::find(activeAttributes, name) == std::end(activeAttributes);
}

bool isSafeUrl(std::string_view url) {
  std::string scheme;
  for (const char c : url) {
    if (static_cast<unsigned char>(c) <= ' ' || c == 0x7f)
      continue; // browsers remove such characters
    if (c == ':')
      break;
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '+' && c != '-' && c != '.')
      return true; // a path without a scheme
    scheme += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  const bool hasColon = url.find(':') != url.npos;
  return !hasColon || scheme == "http" || scheme == "https";
}

std::map<std::string, std::size_t> elementsLeftOutOfPage(const SceneGraph& graph) {
  std::map<std::string, std::size_t> counts;
  for (const std::size_t index : nodesOfDocument(graph, graph.roots))
    if (const GenericNode* generic = std::get_if<GenericNode>(&graph.nodes[index].content))
      if (!isAllowedInPage(generic->element) && generic->element != commentElement)
        ++counts[generic->element];
  return counts;
}

std::string safeUrls(std::string_view text) {
  std::vector<std::string> urls = parseStrings(text);
  std::erase_if(urls, [](const std::string& url) { return !isSafeUrl(url); });
  return urls.empty() ? "" : quoteStrings(urls);
}

} // namespace imgeo
