#include "import/x3d/node_table.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace imgeo::x3d {

namespace {

using enum NodeTreatment;

// Reasons that several nodes share. Summaries say "Without effect, since …: …" and "… left out, since …".
constexpr std::string_view animates = "pages do not animate or interact", sounds = "pages play no sound",
                           notDrawn = "pages do not draw this geometry",
                           noVolumes = "pages render no volumes and no three-dimensional textures",
                           noShaders = "pages run no shaders of others; the material beside it is drawn",
                           noPhysics = "pages simulate no rigid bodies", noParticles = "pages emit no particles",
                           noNetwork = "pages join no distributed simulation",
                           noGeospatial = "imgeo does not convert geographic coordinates",
                           noLayout = "pages lay out nothing on the screen";

// What several nodes become.
constexpr std::string_view asGroup = "Group", asTransform = "Transform",
                           asExpanded = "the nodes that instances of the prototype stand for";

constexpr NodeRow x3dNodes[] = {
    {"AcousticProperties", "Shape", 5, "acousticProperties", kept, ""},
    {"Analyser", "Sound", 2, "children", kept, sounds},
    {"Anchor", "Networking", 2, "children", drawn, ""},
    {"Appearance", "Shape", 1, "appearance", drawn, ""},
    {"Arc2D", "Geometry2D", 2, "geometry", drawn, ""},
    {"ArcClose2D", "Geometry2D", 2, "geometry", drawn, ""},
    {"AudioClip", "Sound", 1, "source", kept, sounds},
    {"AudioDestination", "Sound", 2, "children", kept, sounds},
    {"Background", "EnvironmentalEffects", 1, "children", drawn, ""},
    {"BallJoint", "RigidBodyPhysics", 2, "joints", dropped, noPhysics},
    {"Billboard", "Navigation", 2, "children", drawn, ""},
    {"BiquadFilter", "Sound", 2, "children", kept, sounds},
    {"BlendedVolumeStyle", "VolumeRendering", 3, "renderStyle", dropped, noVolumes},
    {"BooleanFilter", "EventUtilities", 1, "children", kept, animates},
    {"BooleanSequencer", "EventUtilities", 1, "children", kept, animates},
    {"BooleanToggle", "EventUtilities", 1, "children", kept, animates},
    {"BooleanTrigger", "EventUtilities", 1, "children", kept, animates},
    {"BoundaryEnhancementVolumeStyle", "VolumeRendering", 2, "renderStyle", dropped, noVolumes},
    {"BoundedPhysicsModel", "ParticleSystems", 2, "physics", dropped, noParticles},
    {"Box", "Geometry3D", 1, "geometry", drawn, ""},
    {"BufferAudioSource", "Sound", 2, "children", kept, sounds},
    {"CADAssembly", "CADGeometry", 2, "children", converted, asGroup},
    {"CADFace", "CADGeometry", 2, "children", converted, asGroup},
    {"CADLayer", "CADGeometry", 2, "children", converted, asGroup},
    {"CADPart", "CADGeometry", 2, "children", converted, asTransform},
    {"CartoonVolumeStyle", "VolumeRendering", 3, "renderStyle", dropped, noVolumes},
    {"ChannelMerger", "Sound", 2, "children", kept, sounds},
    {"ChannelSelector", "Sound", 2, "children", kept, sounds},
    {"ChannelSplitter", "Sound", 2, "children", kept, sounds},
    {"Circle2D", "Geometry2D", 2, "geometry", drawn, ""},
    {"ClipPlane", "Rendering", 5, "children", kept, "pages clip nothing"},
    {"CollidableOffset", "RigidBodyPhysics", 1, "children", converted, asTransform},
    {"CollidableShape", "RigidBodyPhysics", 1, "children", converted, asTransform},
    {"Collision", "Navigation", 2, "children", drawn, ""},
    {"CollisionCollection", "RigidBodyPhysics", 1, "collider", dropped, noPhysics},
    {"CollisionSensor", "RigidBodyPhysics", 1, "children", kept, animates},
    {"CollisionSpace", "RigidBodyPhysics", 1, "children", dropped, noPhysics},
    {"Color", "Rendering", 1, "color", drawn, ""},
    {"ColorChaser", "Followers", 1, "children", kept, animates},
    {"ColorDamper", "Followers", 1, "children", kept, animates},
    {"ColorInterpolator", "Interpolation", 2, "children", kept, animates},
    {"ColorRGBA", "Rendering", 1, "color", drawn, ""},
    {"ComposedCubeMapTexture", "CubeMapTexturing", 1, "texture", kept, "pages draw no cube maps"},
    {"ComposedShader", "Shaders", 1, "shaders", dropped, noShaders},
    {"ComposedTexture3D", "Texturing3D", 1, "texture", dropped, noVolumes},
    {"ComposedVolumeStyle", "VolumeRendering", 3, "renderStyle", dropped, noVolumes},
    {"Cone", "Geometry3D", 1, "geometry", drawn, ""},
    {"ConeEmitter", "ParticleSystems", 1, "emitter", dropped, noParticles},
    {"Contact", "RigidBodyPhysics", 2, "contacts", dropped, noPhysics},
    {"Contour2D", "NURBS", 4, "trimmingContour", kept, notDrawn},
    {"ContourPolyline2D", "NURBS", 3, "children", kept, notDrawn},
    {"Convolver", "Sound", 2, "children", kept, sounds},
    {"Coordinate", "Rendering", 1, "coord", drawn, ""},
    {"CoordinateChaser", "Followers", 1, "children", kept, animates},
    {"CoordinateDamper", "Followers", 1, "children", kept, animates},
    {"CoordinateDouble", "Rendering", 1, "coord", drawn, ""},
    {"CoordinateInterpolator", "Interpolation", 1, "children", kept, animates},
    {"CoordinateInterpolator2D", "Interpolation", 3, "children", kept, animates},
    {"Cylinder", "Geometry3D", 1, "geometry", drawn, ""},
    {"CylinderSensor", "PointingDeviceSensor", 1, "children", kept, animates},
    {"DISEntityManager", "DIS", 2, "children", dropped, noNetwork},
    {"DISEntityTypeMapping", "DIS", 2, "children", dropped, noNetwork},
    {"Delay", "Sound", 2, "children", kept, sounds},
    {"DirectionalLight", "Lighting", 1, "children", drawn, ""},
    {"Disk2D", "Geometry2D", 2, "geometry", drawn, ""},
    {"DoubleAxisHingeJoint", "RigidBodyPhysics", 2, "joints", dropped, noPhysics},
    {"DynamicsCompressor", "Sound", 2, "children", kept, sounds},
    {"EaseInEaseOut", "Interpolation", 4, "children", kept, animates},
    {"EdgeEnhancementVolumeStyle", "VolumeRendering", 2, "renderStyle", dropped, noVolumes},
    {"ElevationGrid", "Geometry3D", 3, "geometry", drawn, ""},
    {"EnvironmentLight", "Lighting", 3, "children", kept, "pages have no light of the surroundings"},
    {"EspduTransform", "DIS", 1, "children", converted, asTransform},
    {"ExplosionEmitter", "ParticleSystems", 1, "emitter", dropped, noParticles},
    {"Extrusion", "Geometry3D", 4, "geometry", drawn, ""},
    {"FillProperties", "Shape", 3, "fillProperties", kept, "pages fill every face"},
    {"FloatVertexAttribute", "Shaders", 1, "attrib", kept, "pages colour by attributes of other formats alone"},
    {"Fog", "EnvironmentalEffects", 2, "children", kept, "pages draw no fog"},
    {"FogCoordinate", "EnvironmentalEffects", 4, "fogCoord", kept, "pages draw no fog"},
    {"FontStyle", "Text", 1, "fontStyle", drawn, ""},
    {"ForcePhysicsModel", "ParticleSystems", 1, "physics", dropped, noParticles},
    {"Gain", "Sound", 2, "children", kept, sounds},
    {"GeneratedCubeMapTexture", "CubeMapTexturing", 3, "texture", kept, "pages draw no cube maps"},
    {"GeoCoordinate", "Geospatial", 1, "coord", dropped, noGeospatial},
    {"GeoElevationGrid", "Geospatial", 1, "geometry", dropped, noGeospatial},
    {"GeoLOD", "Geospatial", 1, "children", dropped, noGeospatial},
    {"GeoLocation", "Geospatial", 1, "children", dropped, noGeospatial},
    {"GeoMetadata", "Geospatial", 1, "children", kept, ""},
    {"GeoOrigin", "Geospatial", 1, "geoOrigin", dropped, noGeospatial},
    {"GeoPositionInterpolator", "Geospatial", 1, "children", kept, animates},
    {"GeoProximitySensor", "Geospatial", 2, "children", kept, animates},
    {"GeoTouchSensor", "Geospatial", 1, "children", kept, animates},
    {"GeoTransform", "Geospatial", 2, "children", dropped, noGeospatial},
    {"GeoViewpoint", "Geospatial", 1, "children", dropped, noGeospatial},
    {"Group", "Grouping", 1, "children", drawn, ""},
    {"HAnimDisplacer", "HAnim", 1, "displacers", kept, animates},
    {"HAnimHumanoid", "HAnim", 1, "children", converted, asTransform},
    {"HAnimJoint", "HAnim", 1, "children", converted, asTransform},
    {"HAnimMotion", "HAnim", 2, "motions", kept, animates},
    {"HAnimSegment", "HAnim", 1, "children", converted, asGroup},
    {"HAnimSite", "HAnim", 1, "children", converted, asTransform},
    {"ImageCubeMapTexture", "CubeMapTexturing", 2, "texture", kept, "pages draw no cube maps"},
    {"ImageTexture", "Texturing", 1, "texture", drawn, ""},
    {"ImageTexture3D", "Texturing3D", 2, "texture", dropped, noVolumes},
    {"IndexedFaceSet", "Geometry3D", 2, "geometry", drawn, ""},
    {"IndexedLineSet", "Rendering", 1, "geometry", drawn, ""},
    {"IndexedQuadSet", "CADGeometry", 1, "geometry", drawn, ""},
    {"IndexedTriangleFanSet", "Rendering", 3, "geometry", drawn, ""},
    {"IndexedTriangleSet", "Rendering", 3, "geometry", drawn, ""},
    {"IndexedTriangleStripSet", "Rendering", 3, "geometry", drawn, ""},
    {"Inline", "Networking", 2, "children", drawn, ""},
    {"IntegerSequencer", "EventUtilities", 1, "children", kept, animates},
    {"IntegerTrigger", "EventUtilities", 1, "children", kept, animates},
    {"IsoSurfaceVolumeData", "VolumeRendering", 2, "children", dropped, noVolumes},
    {"KeySensor", "KeyDeviceSensor", 1, "children", kept, animates},
    {"LOD", "Navigation", 2, "children", drawn, ""},
    {"Layer", "Layering", 1, "layers", converted, asGroup},
    {"LayerSet", "Layering", 1, "children", converted, asGroup},
    {"Layout", "Layout", 1, "layout", dropped, noLayout},
    {"LayoutGroup", "Layout", 1, "children", dropped, noLayout},
    {"LayoutLayer", "Layout", 1, "layers", dropped, noLayout},
    {"LinePickSensor", "Picking", 1, "children", kept, animates},
    {"LineProperties", "Shape", 2, "lineProperties", drawn, ""},
    {"LineSet", "Rendering", 1, "geometry", drawn, ""},
    {"ListenerPointSource", "Sound", 2, "children", kept, sounds},
    {"LoadSensor", "Networking", 3, "children", kept, animates},
    {"LocalFog", "EnvironmentalEffects", 4, "children", kept, "pages draw no fog"},
    {"Material", "Shape", 1, "material", drawn, ""},
    {"Matrix3VertexAttribute", "Shaders", 1, "attrib", dropped, noShaders},
    {"Matrix4VertexAttribute", "Shaders", 1, "attrib", dropped, noShaders},
    {"MetadataBoolean", "Core", 1, "metadata", kept, ""},
    {"MetadataDouble", "Core", 1, "metadata", kept, ""},
    {"MetadataFloat", "Core", 1, "metadata", kept, ""},
    {"MetadataInteger", "Core", 1, "metadata", kept, ""},
    {"MetadataSet", "Core", 1, "metadata", kept, ""},
    {"MetadataString", "Core", 1, "metadata", kept, ""},
    {"MicrophoneSource", "Sound", 2, "children", kept, sounds},
    {"MotorJoint", "RigidBodyPhysics", 2, "joints", dropped, noPhysics},
    {"MovieTexture", "Texturing", 3, "texture", dropped, "pages play no movies"},
    {"MultiTexture", "Texturing", 2, "texture", drawn, "its first texture"},
    {"MultiTextureCoordinate", "Texturing", 2, "texCoord", drawn, "its first set"},
    {"MultiTextureTransform", "Texturing", 2, "textureTransform", drawn, "the transform of each mapping"},
    {"NavigationInfo", "Navigation", 1, "children", drawn, ""},
    {"Normal", "Rendering", 2, "normal", drawn, ""},
    {"NormalInterpolator", "Interpolation", 2, "children", kept, animates},
    {"NurbsCurve", "NURBS", 1, "geometry", kept, notDrawn},
    {"NurbsCurve2D", "NURBS", 3, "children", kept, notDrawn},
    {"NurbsOrientationInterpolator", "NURBS", 1, "children", kept, animates},
    {"NurbsPatchSurface", "NURBS", 1, "geometry", kept, notDrawn},
    {"NurbsPositionInterpolator", "NURBS", 1, "children", kept, animates},
    {"NurbsSet", "NURBS", 2, "children", kept, notDrawn},
    {"NurbsSurfaceInterpolator", "NURBS", 1, "children", kept, animates},
    {"NurbsSweptSurface", "NURBS", 3, "geometry", kept, notDrawn},
    {"NurbsSwungSurface", "NURBS", 3, "geometry", kept, notDrawn},
    {"NurbsTextureCoordinate", "NURBS", 1, "texCoord", kept, notDrawn},
    {"NurbsTrimmedSurface", "NURBS", 4, "geometry", kept, notDrawn},
    {"OpacityMapVolumeStyle", "VolumeRendering", 1, "renderStyle", dropped, noVolumes},
    {"OrientationChaser", "Followers", 1, "children", kept, animates},
    {"OrientationDamper", "Followers", 1, "children", kept, animates},
    {"OrientationInterpolator", "Interpolation", 1, "children", kept, animates},
    {"OrthoViewpoint", "Navigation", 3, "children", drawn, ""},
    {"OscillatorSource", "Sound", 2, "children", kept, sounds},
    {"PackagedShader", "Shaders", 1, "shaders", dropped, noShaders},
    {"ParticleSystem", "ParticleSystems", 2, "children", dropped, noParticles},
    {"PeriodicWave", "Sound", 2, "periodicWave", kept, sounds},
    {"PhysicalMaterial", "Shape", 2, "material", drawn, ""},
    {"PickableGroup", "Picking", 1, "children", converted, asGroup},
    {"PixelTexture", "Texturing", 1, "texture", drawn, ""},
    {"PixelTexture3D", "Texturing3D", 1, "texture", dropped, noVolumes},
    {"PlaneSensor", "PointingDeviceSensor", 1, "children", kept, animates},
    {"PointEmitter", "ParticleSystems", 1, "emitter", dropped, noParticles},
    {"PointLight", "Lighting", 2, "children", drawn, ""},
    {"PointPickSensor", "Picking", 1, "children", kept, animates},
    {"PointProperties", "Shape", 5, "pointProperties", drawn, ""},
    {"PointSet", "Rendering", 1, "geometry", drawn, ""},
    {"Polyline2D", "Geometry2D", 1, "geometry", drawn, ""},
    {"PolylineEmitter", "ParticleSystems", 1, "emitter", dropped, noParticles},
    {"Polypoint2D", "Geometry2D", 1, "geometry", drawn, ""},
    {"PositionChaser", "Followers", 1, "children", kept, animates},
    {"PositionChaser2D", "Followers", 1, "children", kept, animates},
    {"PositionDamper", "Followers", 1, "children", kept, animates},
    {"PositionDamper2D", "Followers", 1, "children", kept, animates},
    {"PositionInterpolator", "Interpolation", 1, "children", kept, animates},
    {"PositionInterpolator2D", "Interpolation", 3, "children", kept, animates},
    {"PrimitivePickSensor", "Picking", 2, "children", kept, animates},
    {"ProgramShader", "Shaders", 1, "shaders", dropped, noShaders},
    {"ProjectionVolumeStyle", "VolumeRendering", 2, "renderStyle", dropped, noVolumes},
    {"ProximitySensor", "EnvironmentalSensor", 1, "children", kept, animates},
    {"QuadSet", "CADGeometry", 1, "geometry", drawn, ""},
    {"ReceiverPdu", "DIS", 1, "children", dropped, noNetwork},
    {"Rectangle2D", "Geometry2D", 1, "geometry", drawn, ""},
    {"RigidBody", "RigidBodyPhysics", 2, "bodies", dropped, noPhysics},
    {"RigidBodyCollection", "RigidBodyPhysics", 2, "children", dropped, noPhysics},
    {"ScalarChaser", "Followers", 1, "children", kept, animates},
    {"ScalarDamper", "Followers", 1, "children", kept, animates},
    {"ScalarInterpolator", "Interpolation", 1, "children", kept, animates},
    {"ScreenFontStyle", "Layout", 2, "fontStyle", dropped, noLayout},
    {"ScreenGroup", "Layout", 2, "children", dropped, noLayout},
    {"Script", "Scripting", 1, "children", dropped, "pages run no scripts"},
    {"SegmentedVolumeData", "VolumeRendering", 2, "children", dropped, noVolumes},
    {"ShadedVolumeStyle", "VolumeRendering", 3, "renderStyle", dropped, noVolumes},
    {"ShaderPart", "Shaders", 1, "parts", dropped, noShaders},
    {"ShaderProgram", "Shaders", 1, "programs", dropped, noShaders},
    {"Shape", "Shape", 1, "children", drawn, ""},
    {"SignalPdu", "DIS", 1, "children", dropped, noNetwork},
    {"SilhouetteEnhancementVolumeStyle", "VolumeRendering", 2, "renderStyle", dropped, noVolumes},
    {"SingleAxisHingeJoint", "RigidBodyPhysics", 2, "joints", dropped, noPhysics},
    {"SliderJoint", "RigidBodyPhysics", 2, "joints", dropped, noPhysics},
    {"Sound", "Sound", 1, "children", kept, sounds},
    {"SpatialSound", "Sound", 2, "children", kept, sounds},
    {"Sphere", "Geometry3D", 1, "geometry", drawn, ""},
    {"SphereSensor", "PointingDeviceSensor", 1, "children", kept, animates},
    {"SplinePositionInterpolator", "Interpolation", 4, "children", kept, animates},
    {"SplinePositionInterpolator2D", "Interpolation", 4, "children", kept, animates},
    {"SplineScalarInterpolator", "Interpolation", 4, "children", kept, animates},
    {"SpotLight", "Lighting", 2, "children", drawn, ""},
    {"SquadOrientationInterpolator", "Interpolation", 5, "children", kept, animates},
    {"StaticGroup", "Grouping", 3, "children", drawn, ""},
    {"StreamAudioDestination", "Sound", 2, "children", kept, sounds},
    {"StreamAudioSource", "Sound", 2, "children", kept, sounds},
    {"StringSensor", "KeyDeviceSensor", 2, "children", kept, animates},
    {"SurfaceEmitter", "ParticleSystems", 2, "emitter", dropped, noParticles},
    {"Switch", "Grouping", 2, "children", drawn, ""},
    {"TexCoordChaser2D", "Followers", 1, "children", kept, animates},
    {"TexCoordDamper2D", "Followers", 1, "children", kept, animates},
    {"Text", "Text", 1, "geometry", drawn, ""},
    {"TextureBackground", "EnvironmentalEffects", 3, "children", drawn, ""},
    {"TextureCoordinate", "Texturing", 1, "texCoord", drawn, ""},
    {"TextureCoordinate3D", "Texturing3D", 1, "texCoord", kept, "pages generate no texture coordinates"},
    {"TextureCoordinate4D", "Texturing3D", 1, "texCoord", kept, "pages generate no texture coordinates"},
    {"TextureCoordinateGenerator", "Texturing", 2, "texCoord", drawn,
     "modes that depend on the camera or on noise are approximated"},
    {"TextureProjector", "TextureProjection", 2, "children", dropped, "pages project no textures"},
    {"TextureProjectorParallel", "TextureProjection", 2, "children", dropped, "pages project no textures"},
    {"TextureProperties", "Texturing", 2, "textureProperties", drawn, ""},
    {"TextureTransform", "Texturing", 1, "textureTransform", drawn, ""},
    {"TextureTransform3D", "Texturing3D", 1, "textureTransform", dropped, noVolumes},
    {"TextureTransformMatrix3D", "Texturing3D", 1, "textureTransform", dropped, noVolumes},
    {"TimeSensor", "Time", 1, "children", kept, animates},
    {"TimeTrigger", "EventUtilities", 1, "children", kept, animates},
    {"ToneMappedVolumeStyle", "VolumeRendering", 2, "renderStyle", dropped, noVolumes},
    {"TouchSensor", "PointingDeviceSensor", 1, "children", kept, animates},
    {"Transform", "Grouping", 1, "children", drawn, ""},
    {"TransformSensor", "EnvironmentalSensor", 3, "children", kept, animates},
    {"TransmitterPdu", "DIS", 1, "children", dropped, noNetwork},
    {"TriangleFanSet", "Rendering", 3, "geometry", drawn, ""},
    {"TriangleSet", "Rendering", 3, "geometry", drawn, ""},
    {"TriangleSet2D", "Geometry2D", 1, "geometry", drawn, ""},
    {"TriangleStripSet", "Rendering", 3, "geometry", drawn, ""},
    {"TwoSidedMaterial", "Shape", 4, "material", converted, "Material, of the front"},
    {"UniversalJoint", "RigidBodyPhysics", 2, "joints", dropped, noPhysics},
    {"UnlitMaterial", "Shape", 1, "material", drawn, ""},
    {"Viewpoint", "Navigation", 1, "children", drawn, ""},
    {"ViewpointGroup", "Navigation", 3, "children", converted, asGroup},
    {"Viewport", "Layering", 1, "viewport", kept, ""},
    {"VisibilitySensor", "EnvironmentalSensor", 2, "children", kept, animates},
    {"VolumeData", "VolumeRendering", 1, "children", dropped, noVolumes},
    {"VolumeEmitter", "ParticleSystems", 2, "emitter", dropped, noParticles},
    {"VolumePickSensor", "Picking", 3, "children", kept, animates},
    {"WaveShaper", "Sound", 2, "children", kept, sounds},
    {"WindPhysicsModel", "ParticleSystems", 1, "physics", dropped, noParticles},
    {"WorldInfo", "Core", 1, "children", kept, ""},
};

constexpr NodeRow nodesOfOthers[] = {
    {"BinaryGeometry", "imgeo", 0, "geometry", drawn, ""},
    {"CommonSurfaceShader", "X3DOM", 0, "shaders", converted, "Material"},
    {"Effect", "Castle Game Engine", 0, "effects", dropped, noShaders},
    {"EffectPart", "Castle Game Engine", 0, "parts", dropped, noShaders},
    {"GeometryPatch", "imgeo", 0, "children", drawn, ""},
    {"ImageGeometry", "imgeo", 0, "geometry", drawn, ""},
    {"ScreenEffect", "Castle Game Engine", 0, "children", dropped, noShaders},
    {"SurfaceShaderTexture", "X3DOM", 0, "diffuseTexture", converted, "its texture"},

};

constexpr NodeRow statements[] = {
    {"EXPORT", "statement", 0, "children", kept, animates},
    {"ExternProtoDeclare", "statement", 0, "children", converted, asExpanded},
    {"IMPORT", "statement", 0, "children", kept, animates},
    {"IS", "statement", 0, "children", converted, asExpanded},
    {"ProtoBody", "statement", 0, "children", converted, asExpanded},
    {"ProtoDeclare", "statement", 0, "children", converted, asExpanded},
    {"ProtoInstance", "statement", 0, "children", converted, asExpanded},
    {"ProtoInterface", "statement", 0, "children", converted, asExpanded},
    {"ROUTE", "statement", 0, "children", kept, animates},
    {"Scene", "statement", 0, "children", drawn, ""},
    {"X3D", "statement", 0, "children", drawn, ""},
    {"component", "statement", 0, "children", kept, ""},
    {"connect", "statement", 0, "children", converted, asExpanded},
    {"field", "statement", 0, "children", converted, asExpanded},
    {"fieldValue", "statement", 0, "children", converted, asExpanded},
    {"head", "statement", 0, "children", kept, ""},
    {"meta", "statement", 0, "children", kept, ""},
    {"unit", "statement", 0, "children", kept, ""},
};

static_assert(std::ranges::is_sorted(x3dNodes, {}, &NodeRow::name));
static_assert(std::ranges::is_sorted(nodesOfOthers, {}, &NodeRow::name));
static_assert(std::ranges::is_sorted(statements, {}, &NodeRow::name));

constexpr auto rows = [] {
  std::array<NodeRow, std::size(x3dNodes) + std::size(nodesOfOthers) + std::size(statements)> all;
  const auto end = std::ranges::copy(nodesOfOthers, std::ranges::copy(x3dNodes, all.begin()).out).out;
  std::ranges::copy(statements, end);
  return all;
}();

const NodeRow* find(std::span<const NodeRow> sorted, std::string_view element) {
  const auto found = std::ranges::lower_bound(sorted, element, {}, &NodeRow::name);
  return found == sorted.end() || found->name != element ? nullptr : &*found;
}

} // namespace

std::span<const NodeRow> nodeTable() {
  return rows;
}

const NodeRow* nodeRow(std::string_view element) {
  for (const std::span<const NodeRow> sorted :
       {std::span<const NodeRow>(x3dNodes), std::span<const NodeRow>(nodesOfOthers),
        std::span<const NodeRow>(statements)})
    if (const NodeRow* row = find(sorted, element))
      return row;
  return nullptr;
}

std::string_view nameOf(NodeTreatment treatment) {
  switch (treatment) {
  case drawn:
    return "drawn";
  case converted:
    return "converted";
  case kept:
    return "kept";
  case dropped:
    return "dropped";
  }
  return {};
}

} // namespace imgeo::x3d
